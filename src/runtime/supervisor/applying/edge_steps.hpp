// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "control/joint_orders.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/plan.hpp"

namespace orca::supervisor {

/// Returns the steps that change connections between components that run, and take the change back if one fails. An edge
/// between two processes gets fresh memory: first its server's end is made, then its client's; they go the other way round. A
/// client makes all its connections before it removes any, so that a port that goes over to another server misses nothing.
///
/// @param graph  that has the components of all connections.
/// @param lost   processes that take no part: what they run begins anew.
/// @errors  unavailable if the system gives no memory.
[[nodiscard]] Result<std::vector<JointStep>> edge_steps(
    const graph::Graph& graph, const std::vector<graph::GraphPlan::Rewiring>& connections,
    const std::set<std::string>& lost = {});

}  // namespace orca::supervisor
