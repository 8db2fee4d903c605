// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>

#include "parts/component_parts.hpp"
#include "parts/component_states.hpp"
#include "parts/residency.hpp"
#include "state/state_keeper.hpp"
#include "state/succession.hpp"

namespace orca::host {

/// The state of one component. It looks up in the table of component_states.hpp what an event means, carries
/// out the actions, and keeps the reason for a failure.
///
/// Thread contract: state(), has_...(), ended_badly(), failure() and refusal() from anywhere, the rest on the
/// component's strand.
class Lifecycle {
 public:
  Lifecycle(ComponentParts& parts, Residency& residency, Succession& succession, StateKeeper& keeper);
  Lifecycle(const Lifecycle&) = delete;
  Lifecycle& operator=(const Lifecycle&) = delete;

  /// Handles an event, and the events that its actions end in.
  void handle(ComponentEvent event);
  /// Reports a failure, then handles the event: `failed` or `threw`.
  /// @param hook  where it happened.
  /// @param what  "threw ...", "failed: ..."
  /// @param port  port of a handler; "" for other hooks.
  void fail_with(ComponentEvent event, Hook hook, const std::string& what, const char* port = "");

  // Orders, carried out between two laps.
  Status suspend();
  Status resume();
  /// Changes all values together, or none.
  /// @errors  the component's own; internal with what it threw.
  Status change_params(const ParamValues& values);
  /// Puts the object of a successor in the place of the present one; see Succession::take_over(). A component that has
  /// failed becomes IDLE.
  /// @errors  also failed_precondition with the state in which that is not possible.
  Status take_over(Residency& successor, bool fresh, TakeOver& report);

  /// Returns whether the lap that began then was one too many that took too long, and the old object is back: see
  /// Succession::judge_lap().
  bool gave_up_lap(TimePoint began) { return succession_.judge_lap(state(), began); }

  [[nodiscard]] ComponentState state() const { return state_.load(std::memory_order_acquire); }
  /// Returns when the state was entered.
  [[nodiscard]] TimePoint entered() const { return entered_; }
  /// Returns whether the component has ever been in WORK_FAILED, even if a new client has made it start anew.
  [[nodiscard]] bool has_failed() const { return has_failed_.load(std::memory_order_acquire); }
  /// Returns whether the component has ever been in WORK.
  [[nodiscard]] bool has_worked() const { return has_worked_.load(std::memory_order_acquire); }
  /// Returns whether its last work, or the attempt to begin it, ended in WORK_FAILED, even if it has become IDLE
  /// since because its clients have gone.
  [[nodiscard]] bool ended_badly() const { return ended_badly_.load(std::memory_order_acquire); }
  /// Returns why the component is in WORK_FAILED.
  [[nodiscard]] std::string failure() const;
  /// Returns why the component could not be configured; nothing if it could.
  [[nodiscard]] std::optional<Error> refusal() const;

 private:
  using FollowUp = std::optional<ComponentEvent>;  // the event that an action ended in

  FollowUp carry_out(const ComponentTransition& transition);
  FollowUp carry_out(ComponentAction action, ComponentState to);
  void arrange(ComponentAction action);
  void enter(ComponentState state);

  FollowUp load();
  FollowUp configure();
  FollowUp refuse(ComponentEvent event, Error reason, const std::string& what);
  FollowUp start();
  FollowUp restore();
  void try_stop();
  FollowUp call(Hook hook, void (Component::*function)(),
                ComponentEvent if_it_throws = ComponentEvent::threw);
  Status order(ComponentEvent event, const std::string& only);
  Status offer_params(const ParamValues& changed, const ParamValues& old);
  ComponentEvent report(ComponentEvent event, Hook hook, const std::string& what, const char* port = "");

  ComponentParts& parts_;
  Residency& residency_;
  Succession& succession_;
  StateKeeper& keeper_;
  TimePoint entered_{};
  std::atomic<ComponentState> state_;
  std::atomic<bool> has_failed_{false};
  std::atomic<bool> has_worked_{false};
  std::atomic<bool> ended_badly_{false};
  mutable std::mutex mutex_;
  std::string failure_;
  std::optional<Error> refusal_;
};

}  // namespace orca::host
