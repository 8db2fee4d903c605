// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// The connections of a graph.
struct WiredEdges {
  std::vector<Edge> edges;
  // Components that may lack a connection which the graph means to give them. What they say about their connections
  // may follow from an error that is reported already.
  std::set<std::string> doubtful;
};

WiredEdges check_wiring(const std::vector<Node>& connections, const Model& model, Report& report);

}  // namespace orca::graph
