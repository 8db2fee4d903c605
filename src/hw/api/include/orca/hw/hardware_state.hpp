// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::hw {

/// The states of a hardware container.
enum class HardwareState {
  closed,
  opening,  ///< Its strand runs and opens the device.
  ready,    ///< The device is open and polled; nobody uses it.
  active,   ///< The device is started: readings come, and commands are carried out.
  fault,    ///< The device or its driver has failed. It stays so.
};

[[nodiscard]] constexpr const char* to_string(HardwareState state) {
  switch (state) {
    case HardwareState::closed: return "Closed";
    case HardwareState::opening: return "Opening";
    case HardwareState::ready: return "Ready";
    case HardwareState::active: return "Active";
    case HardwareState::fault: return "Fault";
  }
  return "?";
}

}  // namespace orca::hw
