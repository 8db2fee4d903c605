// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Warns about parts of a sound graph that can have no effect.
void check_influence(const Model& model, const Graph& graph, Report& report);

}  // namespace orca::graph
