// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "control_desk.hpp"
#include "members/ledger.hpp"
#include "members/member.hpp"
#include "members/roster.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/conclusion.hpp"
#include "orca/host/stop_signal.hpp"
#include "orca/supervisor/exit_reason.hpp"
#include "orca/supervisor/heartbeats.hpp"
#include "orca/supervisor/restart_policy.hpp"
#include "starting/on_demand.hpp"
#include "starting/renewal.hpp"
#include "starting/starter.hpp"

namespace orca::supervisor {

/// Returns whether the end of the run waits for a component of the process.
[[nodiscard]] bool runs_an_end(const graph::Graph& graph, const Member& member);

/// What follows from the end of a process: who learns of it, which others end with it, and what of the run is left.
///
/// Thread contract: the supervisor's thread.
class Losses {
 public:
  /// What it works with. All of it outlives the object.
  struct Place {
    const graph::Graph& graph;
    const std::string& log_name;
    const host::StopSignal& stop;
    Roster& roster;
    Starter& starter;
    Ledger& ledger;
    RestartPolicy& policy;
    Heartbeats& beats;
    ControlDesk& control;
    host::Conclusion& conclusion;
    OnDemand& on_demand;
    Renewal& renewal;
  };

  explicit Losses(Place place) : place_(place) {}

  /// Notes that a process has ended.
  void ended(Member& member, const ExitReason& reason);
  /// Notes that a process could not even be started.
  void could_not_start(Member& member, const Error& error);

  /// Ends a process that is to start anew, or that nobody needs any more.
  /// @param keeps_states  whether it tells the states of its components before.
  void end(Member& member, bool keeps_states = false);

 private:
  // How a process was lost.
  struct Loss {
    bool is_normal;
    bool is_unasked;
    bool had_come_up;
    bool counts = true;  // against the process
  };

  void lose(Member& member, const std::string& how, const Loss& loss);
  void lose_late(const std::string& text, const Loss& loss);
  void cut(const Wiring::Outer& outer, const Member& lost, const std::string& how);
  void obey(const RestartDecision& decision, const std::string& text);

  const Place place_;
};

}  // namespace orca::supervisor
