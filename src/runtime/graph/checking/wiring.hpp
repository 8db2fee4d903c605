// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

std::vector<Edge> check_wiring(const std::vector<Node>& connections, const Model& model, Report& report);

}  // namespace orca::graph
