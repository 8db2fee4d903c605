// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "node.hpp"
#include "report.hpp"

namespace orca::graph {

// Reports a bad name of the node. Names that are missing or unknown are reported already.
void check_name(const Node& node, const char* attribute, Report& report);

}  // namespace orca::graph
