// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/graph/graph.hpp"

namespace orca::graph {

/// Returns the graph as a Mermaid flow chart, which many web pages and editors draw. Shows what dot() shows.
///
/// @param profiles  the profiles merged into it, for the title; may be empty.
[[nodiscard]] std::string mermaid(const Graph& graph, const std::string& profiles);

}  // namespace orca::graph
