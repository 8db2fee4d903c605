// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
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

}  // namespace orca::emulators
