// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "checking/model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Reports what cannot be in a process that is started on demand, and connections that could not wake it.
// graph has its ends, its edges and its rules of supervision already.
void check_demand(const Model& model, const Graph& graph, Report& report);

}  // namespace orca::graph
