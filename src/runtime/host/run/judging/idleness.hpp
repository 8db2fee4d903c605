// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/graph/graph.hpp"
#include "orca/host/run_result.hpp"
#include "run/reporter.hpp"
#include "run/system.hpp"

namespace orca::host {

/// Writes a warning to the log for each component that has done nothing in the whole run, with the reason, and one
/// if nothing went over any connection. A component that only serves others, or that is loaded on demand, may have
/// had nothing to do.
/// @pre  the system was built from this graph.
/// @thread  any.
void report_idleness(const graph::Graph& graph, const System& system, const RunCounters& counters,
                     Reporter& reporter);

}  // namespace orca::host
