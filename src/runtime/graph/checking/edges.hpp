// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "endpoints.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Returns the edge between two existing ends if they fit together, with the queue and interval that the
// connection gives; nothing after a report.
std::optional<Edge> make_edge(const Node& connection, const Endpoint& from, const Endpoint& to,
                              Report& report);

}  // namespace orca::graph
