// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "orca/base/state_table.hpp"
#include "orca/host/component_state.hpp"

namespace orca::host {

/// The events that make a component change its state.
enum class ComponentEvent {
  // Circumstances.
  asked_for,  ///< There is a client, an object or a question for a component that is not loaded.
  wanted,     ///< It has a client, or it is to stay active.
  unwanted,   ///< It has no client, and it is not to stay active.
  unused,     ///< An on-demand component has not been used for its idle time.
  replaced,   ///< Another object has taken the place of the present one.
  exit,       ///< The system is being stopped.
  // Orders.
  suspend,
  resume,
  // Outcomes.
  loaded,
  configured,
  started,
  interrupted,  ///< configure() or start() was made to return because the strand is to end.
  done,         ///< work() reports that the task is done.
  failed,       ///< A hook reports a failure.
  threw,        ///< A hook other than stop(), or a handler, threw.
  stop_threw,   ///< stop() threw. It is not called again.
};

/// The actions of a transition.
enum class ComponentAction {
  enter,         ///< The new state holds from here on, and others see it.
  load,          ///< Loads the code and constructs the component.
  configure,     ///< Calls configure().
  open_intake,   ///< From here on requests and sent objects go to the component's handlers.
  hold_intake,   ///< From here on requests and sent objects wait.
  close_intake,  ///< From here on requests and sent objects are refused: the component has failed.
  subscribe,     ///< Subscribes to the component's own providers (thesis Fig. 9.2).
  start,         ///< Calls start().
  begin_laps,    ///< The first lap is due now.
  stop,          ///< Calls stop().
  try_stop,      ///< Calls stop(); an exception is reported and changes nothing.
  unsubscribe,   ///< Unsubscribes from the providers; the task ends.
  suspend,       ///< Calls suspend().
  resume,        ///< Calls resume().
  unload,        ///< Destroys the component and unloads its code.
  end,           ///< Refuses orders, requests and sent objects: the system is being stopped.
};

inline constexpr std::size_t kComponentStates = 11;
inline constexpr std::size_t kComponentEvents = 16;

using ComponentTransition = Transition<ComponentState, ComponentEvent, ComponentAction>;

/// Looks up a transition in the state machine of a component.
///
/// An action may end in an event of its own: start() in `started`, any hook in `threw` or `stop_threw`. That event is handled
/// at once, in the state that holds then, and the rest of the row's actions are left out.
///
/// @return the row for the event in the state, or null if the event leads nowhere; kind_of() tells what a
///         null means.
[[nodiscard]] const ComponentTransition* transition(ComponentState state, ComponentEvent event);

/// Returns all rows, in the order of a component's life.
[[nodiscard]] std::span<const ComponentTransition> component_transitions();

[[nodiscard]] constexpr EventKind kind_of(ComponentEvent event) {
  if (event <= ComponentEvent::exit) return EventKind::circumstance;
  return event <= ComponentEvent::resume ? EventKind::order : EventKind::outcome;
}

/// Returns whether requests and sent objects are handled in this state, between two laps.
[[nodiscard]] constexpr bool takes_intake(ComponentState state) {
  return state == ComponentState::idle || state == ComponentState::work || state == ComponentState::work_done;
}

}  // namespace orca::host
