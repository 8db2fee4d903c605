// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "state_hooks.hpp"

namespace orca::host {

/// The state of one component as it is kept outside the process, and given to the object that begins after the process was
/// lost (restore="last" in the graph). It is saved after laps and handlers, at most every kInterval, and only if it differs from
/// the one that is kept already.
///
/// Thread contract: the component's strand.
class StateKeeper {
 public:
  static constexpr Duration kInterval{100ms};

  StateKeeper(ComponentParts& parts, Residency& residency);

  /// Notes that the state may have changed.
  void note_change() { has_changed_ = keeps_; }
  /// Returns when the state is to be kept; kForever if it is kept already, or nobody keeps it.
  [[nodiscard]] TimePoint due() const;
  /// Keeps the state. @pre  can_tell_its_state().
  void keep();
  /// Keeps the state at the end of the component, whatever the graph says of it, unless it is empty. @pre  can_tell_its_state().
  void keep_last();

  /// Returns whether the object has not been given yet the state that its predecessor had.
  [[nodiscard]] bool awaits_restore() const { return !is_restored_ && state_; }
  /// Gives the object the state that its predecessor had in a process which has ended; later calls do nothing. A state that the
  /// object cannot read is left unread, with a line in the log.
  /// @errors  what load_state() said or threw.
  Status restore();
  /// Does the same before the object is started, because it is to handle something. Since start() may begin anew, what the
  /// object has then is given to it once more by the first restore() after prepare_start().
  Status restore_early();
  /// To be called before start().
  /// @errors  what save_state() threw.
  Status prepare_start();

 private:
  void hand_out(KeptState saved);
  void give_up(const std::string& why);

  ComponentParts& parts_;
  StateHooks hooks_;
  bool keeps_;
  bool has_changed_ = false;
  std::optional<KeptState> state_;  // that the object begins with
  bool is_restored_ = false;
  bool is_told_ = false;   // in the log
  bool is_early_ = false;  // restored, but not started yet
  TimePoint last_{};       // time of the last keep()
  KeptState kept_;
};

}  // namespace orca::host
