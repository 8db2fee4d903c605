// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "orca/base/state_table.hpp"
#include "orca/hw/hardware_state.hpp"

namespace orca::hw {

/// The events that may make a hardware container change its state.
enum class HardwareEvent {
  // Circumstances.
  wanted,     ///< Somebody uses the device.
  unwanted,   ///< Nobody uses it.
  shut_down,  ///< The system is being stopped, or the driver exchanged, and the device does not work any more.
  // Orders.
  run,
  // Outcomes.
  begun,   ///< The container's strand runs.
  failed,  ///< A function of the driver reports an error or throws.
};

/// The actions of a transition.
enum class HardwareAction {
  enter,     ///< The new state holds from here on and is visible to others.
  open,      ///< Calls open().
  start,     ///< Calls start().
  halt,      ///< The motion endpoint drops its command.
  stand,     ///< Calls drive() with speed 0, unless the motors have that set-point already.
  stop,      ///< Calls stop().
  try_stop,  ///< Calls drive() with speed 0, then stop(), as far as they still work.
  forget,    ///< The sensor endpoints drop their latest readings.
  close,     ///< Calls close().
};

inline constexpr std::size_t kHardwareStates = 5;
inline constexpr std::size_t kHardwareEvents = 6;

using HardwareTransition = Transition<HardwareState, HardwareEvent, HardwareAction>;

/// The state machine of a hardware container.
///
/// Any call of the driver may end in the event `failed`. That event is taken at once, in the state that holds
/// then, and the rest of its row is left out.
///
/// @return the row for the event in the state, or null if the event leads nowhere; kind_of() explains what
/// that
///         means.
[[nodiscard]] const HardwareTransition* transition(HardwareState state, HardwareEvent event);

/// Returns all rows, in the order of a container's life.
[[nodiscard]] std::span<const HardwareTransition> hardware_transitions();

[[nodiscard]] constexpr EventKind kind_of(HardwareEvent event) {
  if (event <= HardwareEvent::shut_down) return EventKind::circumstance;
  return event == HardwareEvent::run ? EventKind::order : EventKind::outcome;
}

}  // namespace orca::hw
