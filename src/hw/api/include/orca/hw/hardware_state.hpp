// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::hw {

/// The states of a hardware container.
enum class HardwareState {
  closed,
  opening,  ///< Its strand runs and opens the device.
  probing,  ///< The port is open; the driver finds out what is there, and waits for its answer.
  ready,    ///< The device is open and polled; nobody uses it.
  active,   ///< The device is started: readings come, and commands are carried out.
  fault,    ///< The device or its driver has failed. It stays so, unless the device can be opened again.
  backoff,  ///< The device has failed and is closed; it is opened again after a while.
};

[[nodiscard]] constexpr const char* to_string(HardwareState state) {
  switch (state) {
    case HardwareState::closed: return "Closed";
    case HardwareState::opening: return "Opening";
    case HardwareState::probing: return "Probing";
    case HardwareState::ready: return "Ready";
    case HardwareState::active: return "Active";
    case HardwareState::fault: return "Fault";
    case HardwareState::backoff: return "Backoff";
  }
  return "?";
}

}  // namespace orca::hw
