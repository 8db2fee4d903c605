// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/run_page.hpp"

namespace orca::supervisor {

/// What all processes of a run on this machine share, and what makes it this run. A supervisor that adopts processes goes
/// on with theirs.
struct RunIdentity {
  RunPage page;
  TimePoint start;                     ///< Of the run, which the log counts from.
  std::string name;                    ///< Which no other run has.
  std::vector<std::string> doorbells;  ///< The components whose doorbells are in the page, in this order.
  std::vector<std::string> processes;  ///< Those that have a place in the page, in this order; "": nobody's.
  bool is_inherited = false;           ///< Another supervisor has begun the run.
};

/// Begins a new run.
/// @errors  as RunPage::create().
[[nodiscard]] Result<RunIdentity> begin_run(const graph::Graph& graph, const std::string& machine);

}  // namespace orca::supervisor
