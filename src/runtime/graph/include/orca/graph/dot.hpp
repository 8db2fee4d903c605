// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/graph/graph.hpp"

namespace orca::graph {

/// Returns the graph as a picture for Graphviz (`deployer GRAPH --dot | dot -Tsvg`): components and hardware
/// with their types, connections with their ports, processes and sub-graphs as boxes, late-bound edges dashed.
///
/// @param profiles  the profiles merged into it, for the title; may be empty.
[[nodiscard]] std::string dot(const Graph& graph, const std::string& profiles);

}  // namespace orca::graph
