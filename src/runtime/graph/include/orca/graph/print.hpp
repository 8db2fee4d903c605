// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/graph/graph.hpp"

namespace orca::graph {

/// Returns the graph as XML again, with profiles merged, arguments replaced, defaults filled in and values in
/// SI. Loading that text gives an equal Graph.
[[nodiscard]] std::string print(const Graph& graph);

/// Returns the value of a parameter as print() writes it.
[[nodiscard]] std::string print_value(const ParamValue& value);

}  // namespace orca::graph
