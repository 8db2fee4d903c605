// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

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

  /// Gives the object the state that its predecessor had in a process which was lost; later calls do nothing. A state that the
  /// object cannot read is left unread, with a line in the log.
  /// @errors  what load_state() said or threw.
  Status restore();

 private:
  void give_up(const std::string& why);

  ComponentParts& parts_;
  StateHooks hooks_;
  bool keeps_;
  bool has_changed_ = false;
  bool is_restored_ = false;
  TimePoint last_{};  // time of the last keep()
  KeptState kept_;
};

}  // namespace orca::host
