// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "checking/model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Returns the groups, in the order of the file. Call it after check_components().
std::vector<GroupNode> check_groups(const std::vector<Node>& nodes, const Model& model, Report& report);

}  // namespace orca::graph
