// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "model.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

/// Reports drivers of lines `emulated:NAME` that no hardware of the graph offers: an error if some hardware emulates others, else a
/// warning, for the emulation may be another system's.
/// @param nodes  those of the model's hardware, in its order.
void check_emulated_lines(const std::vector<Node>& nodes, const Model& model, Report& report);

}  // namespace orca::graph
