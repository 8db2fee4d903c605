// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca {

/// The hardware of a component as its host hands it on. The host knows nothing more about it.
/// orca::hw::HardwareSeat is the only kind.
///
/// Thread contract: that of orca::hw::HardwareSeat.
class Device {
 public:
  Device() = default;
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
};

}  // namespace orca
