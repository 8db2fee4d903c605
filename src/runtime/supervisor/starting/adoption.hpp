// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "members/ledger.hpp"
#include "members/member.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/host_process.hpp"
#include "orca/supervisor/restart_policy.hpp"
#include "run_identity.hpp"

namespace orca::supervisor {

/// What a supervisor begins with.
struct Beginning {
  RunIdentity run;
  std::vector<AdoptedProcess>
      processes;  ///< Those of the run that wait for a supervisor; none: it is a new run.
};

/// Looks for processes of this graph on this machine that wait for a supervisor, to go on with their run; if there are none,
/// begins a new one. A process that does not answer is killed. The clock of this process is set to that of the run.
/// @errors  as begin_run();  failed_precondition if processes wait that run another graph of this name, or more than one run of it;
///          data_loss if their run page is none.
/// @pre  this process has the control socket of the graph: no other one does the same at this time.
/// @thread  the main thread, before any other thread reads the clock.
[[nodiscard]] Result<Beginning> begin_or_go_on(const graph::Graph& graph, const std::string& machine);

/// Returns who has the words of a run page, in the order of the words, from what each process of the run knows of
/// them: a process that was told of a newcomer only has "" for those before it.
[[nodiscard]] std::vector<std::string> joined_names(const std::vector<std::vector<std::string>>& known);

/// Gives the processes to their members and orders them to obey this supervisor from now on. All that runs again.
/// @param adopted  called for each that has told how it is.
/// @return the members that have none.
/// @thread  the supervisor's.
[[nodiscard]] Members adopt(std::vector<AdoptedProcess> processes, const Members& all,
                            const std::function<void(Member&)>& adopted);

/// Lets adopted processes forget components that the graph does not have: they went once, or the supervisor before was killed
/// while they came or went. What is left of them ends, and until then the ledger takes their reports.
/// @thread  the supervisor's, before it hears what the processes report.
void forget_strangers(const RunIdentity& run, const graph::Graph& graph, const Members& all, Ledger& ledger);

/// Notes that a process was gone before it could be adopted. If its rule is never to start it again, it counts as finished.
/// @return what people should know.
/// @thread  the supervisor's.
Error note_gone(const Member& member, Ledger& ledger, RestartPolicy& policy);

/// Lets a process that works go on without its supervisor if the graph wants it.
/// @thread  the supervisor's.
void let_outlive(Member& member, const graph::Supervision& rules);

}  // namespace orca::supervisor
