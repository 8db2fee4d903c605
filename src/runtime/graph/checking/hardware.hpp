// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "model.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"
#include "types.hpp"

namespace orca::graph {

void check_hardware(const std::vector<Node>& nodes, Types& types, Model& model, Report& report);

}  // namespace orca::graph
