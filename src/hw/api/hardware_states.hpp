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
  wanted,       ///< Somebody uses the device.
  unwanted,     ///< Nobody uses it.
  may_recover,  ///< The device has failed, and to open it again may help.
  retry,        ///< The time has come to open it again.
  shut_down,  ///< The system is being stopped, or the driver exchanged, and the device does not work any more.
  // Orders.
  run,
  // Outcomes.
  begun,         ///< The container's strand is about to open the device.
  answered,      ///< The driver knows what is there.
  unanswered,    ///< It does not know it yet.
  failed,        ///< A function of the driver reports an error or throws.
  failed_again,  ///< The same, for the same reason as before, and the device has not worked meanwhile.
};

/// The actions of a transition.
enum class HardwareAction {
  enter,     ///< The new state holds from here on and is visible to others.
  open,      ///< Calls open().
  probe,     ///< Calls probe().
  start,     ///< Calls start().
  halt,      ///< The motion endpoint drops its command.
  stand,     ///< Calls drive() with speed 0, unless the motors have that set-point already.
  stop,      ///< Calls stop().
  try_stop,  ///< Calls drive() with speed 0, then stop(), as far as they still work.
  forget,    ///< The sensor endpoints drop their latest readings.
  close,     ///< Calls close().
};

inline constexpr std::size_t kHardwareStates = 7;
inline constexpr std::size_t kHardwareEvents = 11;

using HardwareTransition = Transition<HardwareState, HardwareEvent, HardwareAction>;

/// The state machine of a hardware container.
///
/// Any call of the driver may end in the event `failed` or `failed_again`. That event is taken at once, in the state that holds
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
