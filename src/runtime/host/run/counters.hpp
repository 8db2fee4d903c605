// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/graph/graph.hpp"
#include "orca/host/run_result.hpp"
#include "system.hpp"

namespace orca::host {

/// Collects the counters of all connections.
/// @pre  the system was built from this graph.
/// @thread  any.
[[nodiscard]] RunCounters collect_counters(const graph::Graph& graph, const System& system);

}  // namespace orca::host
