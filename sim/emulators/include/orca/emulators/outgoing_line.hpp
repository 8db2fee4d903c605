// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "orca/base/time.hpp"

namespace orca::emulators {

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

}  // namespace orca::emulators
