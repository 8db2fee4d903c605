// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "node.hpp"
#include "orca/base/contract.hpp"
#include "orca/graph/graph.hpp"
#include "report.hpp"

namespace orca::graph {

// Returns all parameters of a hardware or component node: the values that it sets, and defaults for the rest.
// Returns nothing if one of them is wrong.
std::optional<Params> read_params(const Node& node, const Contract& contract, Report& report);

}  // namespace orca::graph
