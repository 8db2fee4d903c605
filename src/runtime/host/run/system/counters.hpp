// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/graph/graph.hpp"
#include "orca/host/run_result.hpp"
#include "system.hpp"

namespace orca::host {

/// Collects the counters of all connections that end in this process: of each edge at its receiving end, of each port that
/// sends, asks or serves.
/// @param graph  of the whole system, of which this process may run a part.
/// @thread  any.
[[nodiscard]] RunCounters collect_counters(const graph::Graph& graph, const System& system);

}  // namespace orca::host
