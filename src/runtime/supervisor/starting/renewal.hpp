// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>

#include "members/conductor.hpp"
#include "members/member.hpp"
#include "members/roster.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/restart_policy.hpp"
#include "starter.hpp"

namespace orca::supervisor {

/// Lets some processes of a run end, and begin again as another graph says, while the others run on. If one of them does not
/// come up, all of them end and begin again as before.
///
/// Components go on from the states that they had at the end, also in other processes than before.
///
/// Thread contract: the supervisor's thread.
class Renewal {
 public:
  /// What it needs of the run. All of it outlives the object.
  struct Place {
    Roster& roster;
    RestartPolicy& policy;
    Starter& starter;
    /// Orders a process to end.
    /// @param keeps_states  whether it tells the states of its components before.
    std::function<void(Member&, bool keeps_states)> end;
    /// Forgets that a component has failed.
    std::function<void(const std::string& component)> pardon;
    std::function<bool()> is_over;  ///< Returns whether the run is.
    const std::string& log_name;
  };
  struct Wish {
    std::set<std::string> processes;  ///< Of either graph.
    std::function<void()> go;         ///< Makes the new graph that of the run. None of the processes runs.
    std::function<void()>
        go_back;  ///< Makes the graph of before that of the run. None of the processes runs.
  };

  Renewal(Conductor& conductor, Place place) : conductor_(conductor), place_(std::move(place)) {}

  /// Does what is wished. A job of the conductor waits for that.
  /// @errors  why the processes run as before, or not at all, because the run is over.
  /// @pre  none is under way.
  Status carry_out(const Wish& wish);
  [[nodiscard]] bool is_under_way() const { return phase_ != Phase::none; }
  /// Notes that a process is about to be started. One that begins with the new graph goes back with the others.
  void note_start(const Member& member);
  /// Notes that a process has ended.
  /// @param is_normal  it ended by itself, with exit status 0.
  /// @param how  for people: "was killed by signal 9".
  /// @return whether it was to end, or that is the end of the attempt: then it is no fault of the run.
  bool lose(const Member& member, bool is_normal, const std::string& how);

 private:
  enum class Phase { none, ending, beginning, ending_again, beginning_again };

  Status go_over();
  Error go_back(const Starter::States& states);
  void end_all(Phase phase);
  void begin_all(Phase phase);
  [[nodiscard]] Members members() const;
  [[nodiscard]] bool has_ended() const;
  [[nodiscard]] bool is_up() const;

  Conductor& conductor_;
  const Place place_;
  Phase phase_ = Phase::none;
  Wish wish_;
  std::set<std::string> others_;    // processes that have begun with the new graph on their own
  std::set<std::string> finished_;  // those of the wish that had ended for good before
  std::optional<Error> failure_;
};

}  // namespace orca::supervisor
