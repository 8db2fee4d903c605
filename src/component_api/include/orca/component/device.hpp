// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca {

/// A hardware container as a component's host hands it on. The host knows nothing more about it.
/// orca::hw::HardwareContainer is the only kind.
///
/// Thread contract: that of orca::hw::HardwareContainer.
class Device {
 public:
  Device() = default;
  /// May throw, because a plugin author's destructor may throw; the runtime contains it.
  virtual ~Device() noexcept(false) = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
};

}  // namespace orca
