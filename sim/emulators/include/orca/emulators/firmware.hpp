// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "orca/base/time.hpp"

namespace orca::emulators {

/// What runs inside a device, at the other end of a line: it takes bytes and sends bytes, and drives and senses the body that
/// it was given. Each kind of device is written from the description of its protocol, not from Orca's driver, and shares only the
/// search for frames and the checksums with that.
///
/// Thread contract: not synchronised.
class Firmware {
 public:
  virtual ~Firmware() = default;

  /// Takes what the host has sent.
  /// @param baud  rate that the host has set; 0: it has none, as with TCP. A device that has another rate understands nothing.
  virtual void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) = 0;

  /// Goes on until now. @pre  now is not before an earlier one.
  /// @return the bytes that have left the line by now; each takes its time at the device's rate.
  virtual std::vector<std::uint8_t> advance(TimePoint now) = 0;

  /// Tells whether a host has the line open, at each look at the line. A device on a serial cable cannot know that; what listens in a
  /// network begins with each host anew.
  virtual void note_host(bool /*is_there*/, TimePoint /*now*/) {}

  /// Returns what talks to one more host of the same device, at the same time; null: the device has one host at a time. Each
  /// may outlive the other, and advance() is called for both.
  [[nodiscard]] virtual std::unique_ptr<Firmware> for_another_host() { return nullptr; }

  /// Switches the device off and on.
  virtual void reset(TimePoint now) = 0;
};

/// The bytes that a device has given to its line: each leaves when those before it have, after its own time at the line's rate.
///
/// Thread contract: not synchronised.
class OutgoingLine {
 public:
  /// @param byte_time  [s] that one byte takes; 0: none, as over TCP.
  void send(std::span<const std::uint8_t> bytes, double byte_time, TimePoint now);
  /// Returns the bytes that have left by now, for a host that hears at the device's rate or, as other bytes, at another one.
  [[nodiscard]] std::vector<std::uint8_t> leave(TimePoint now, bool at_hosts_rate);
  /// Returns when the last byte will have left; long ago if none waits.
  [[nodiscard]] TimePoint idle_at() const { return waiting_.empty() ? TimePoint{} : waiting_.back().leaves; }
  void clear() { waiting_.clear(); }

 private:
  struct Waiting {
    std::uint8_t byte;
    TimePoint leaves;
  };
  std::deque<Waiting> waiting_;
};

/// Adds the number of a command to those that a device has got, for whoever watches it. Of very many the older half is forgotten,
/// because an emulation may run for weeks.
inline void note_command(std::vector<int>& commands, int command) {
  constexpr std::size_t kMostKept = 10'000;
  if (commands.size() >= kMostKept)
    commands.erase(commands.begin(), commands.begin() + static_cast<std::ptrdiff_t>(kMostKept / 2));
  commands.push_back(command);
}

}  // namespace orca::emulators
