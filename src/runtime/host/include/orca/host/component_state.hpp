// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::host {

/// The states of a component. They are those of thesis Fig. 9.1, those for on-demand loading and an
/// operator's pause (ADR 0007), and INIT and EXIT, which the thesis leaves to constructor and destructor.
enum class ComponentState {
  unloaded,        ///< Its code is not in memory: nobody has asked for it, or not for a while.
  init,            ///< It is being loaded and configured.
  idle,            ///< It is ready, and nobody needs it.
  connect,         ///< It is subscribing to its own providers and starting.
  work,            ///< It works, lap by lap.
  work_done,       ///< Its task is done, and a client is still there.
  work_failed,     ///< It has reported a failure. It may try again after its last client has gone.
  broken,          ///< It threw, or it could not be configured. It stays in this state.
  suspended_idle,  ///< Paused while it was IDLE.
  suspended_work,  ///< Paused while it was at WORK.
  exit,            ///< Its strand ends.
};

/// Returns the state's name in traces and messages, in the words of the thesis. Both SUSPENDED states have
/// one name, and a broken component is in WORK_FAILED.
[[nodiscard]] const char* to_string(ComponentState state);

[[nodiscard]] constexpr bool is_suspended(ComponentState state) {
  return state == ComponentState::suspended_idle || state == ComponentState::suspended_work;
}

/// Returns whether the component is in WORK_FAILED, for whatever reason.
[[nodiscard]] constexpr bool is_failed(ComponentState state) {
  return state == ComponentState::work_failed || state == ComponentState::broken;
}

/// Returns whether the component does not work yet, or is paused.
[[nodiscard]] constexpr bool is_unsettled(ComponentState state) {
  return state == ComponentState::init || state == ComponentState::connect || is_suspended(state);
}

}  // namespace orca::host
