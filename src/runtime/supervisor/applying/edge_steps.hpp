// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "control/joint_orders.hpp"
#include "members/member.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/plan.hpp"

namespace orca::supervisor {

/// Returns the steps that change connections between components that run, and take the change back if one fails. Each step
/// concerns one component. An edge between two processes gets fresh memory. The steps come in this order:
///
/// 1. The servers' ends of new edges are made.
/// 2. Clients make all their connections, then remove others, so that a port that goes over to another server misses nothing.
/// 3. The servers' ends of the clients' earlier edges are removed or made anew.
///
/// So a client that refuses has all connections that it had.
///
/// @param graph  that has the components of all connections.
/// @param lost   processes that take no part: what they run begins anew.
/// @param left   outlives the steps. It gets the names of edges that their clients have left while their servers may have not: after a failure their
///               ends need new memory to find each other again.
/// @errors  unavailable if the system gives no memory.
[[nodiscard]] Result<std::vector<JointStep>> edge_steps(
    const graph::Graph& graph, const std::vector<graph::GraphPlan::Rewiring>& connections,
    const std::set<std::string>& lost, std::set<std::string>& left);

/// Lets nobody wait at a component for what is sent or asked on connections whose other end is in a process that begins anew:
/// they have no other end until then.
/// @param wanted  the graph that the run goes over to.
void cut_off(const std::string& component, const graph::GraphPlan& plan, const graph::Graph& wanted,
             const Members& all);

}  // namespace orca::supervisor
