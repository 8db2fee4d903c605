// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "orca/graph/graph.hpp"

namespace orca::graph {

/// Returns the graph as XML again, with profiles merged, arguments replaced, defaults filled in and values in
/// SI. Loading that text gives an equal Graph.
[[nodiscard]] std::string print(const Graph& graph);

/// Returns the value of a parameter as print() writes it.
[[nodiscard]] std::string print_value(const ParamValue& value);

/// Does the same for all values of some parameters, by name.
[[nodiscard]] std::map<std::string, std::string> print_values(const Params& params);

}  // namespace orca::graph
