// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/graph/graph.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Returns the changes in the order of their times. The graphs that they name are not read.
std::vector<PlannedChange> check_changes(const std::vector<Node>& nodes, Report& report);

}  // namespace orca::graph
