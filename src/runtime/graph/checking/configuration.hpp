// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "model.hpp"
#include "orca/graph/catalogue.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// A graph with its connections, and what is known about its faults so far.
struct Configuration {
  const std::vector<Node>& nodes;  // of model.components
  const Model& model;
  const Graph& graph;                     // without components and hardware
  const std::set<std::string>& doubtful;  // see WiredEdges
};

// Calls configure() of the components as a trial and reports what they refuse. Components with an error of their own
// are left out.
void check_configuration(const Configuration& configuration, Catalogue& catalogue, Report& report);

}  // namespace orca::graph
