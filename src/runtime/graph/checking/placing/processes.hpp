// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "checking/model.hpp"
#include "orca/graph/process.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Returns the rules for restarts that the <graph> element gives.
Supervision read_supervision(const Node& root, Report& report);

void check_machines(const std::vector<Node>& nodes, Model& model, Report& report);
// Call it after check_machines().
void check_processes(const std::vector<Node>& nodes, Model& model, Report& report);

}  // namespace orca::graph
