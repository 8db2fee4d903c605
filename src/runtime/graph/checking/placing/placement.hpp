// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "checking/model.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Puts components and hardware into their processes, and reports what cannot live together or apart.
// @param hardware, components  the nodes of model.hardware and model.components
void check_placement(const std::vector<Node>& hardware, const std::vector<Node>& components, Model& model,
                     Report& report);

// Warns about processes and machines of a sound graph on which nothing runs.
void check_nothing_runs(const Model& model, Report& report);

}  // namespace orca::graph
