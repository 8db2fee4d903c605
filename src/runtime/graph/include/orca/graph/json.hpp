// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/graph/graph.hpp"

namespace orca::graph {

/// The graph as JSON, for programs: an object with machines, processes, hardware, components, groups and connections;
/// attributes as in XML, parameters as numbers, flags and texts, in SI.
[[nodiscard]] std::string graph_json(const Graph& graph);

}  // namespace orca::graph
