// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "endpoints.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// The edge between two ends that exist, if they fit together; its queue and interval as the connection says.
// Nothing after a report.
std::optional<Edge> make_edge(const Node& connection, const Endpoint& from, const Endpoint& to,
                              Report& report);

}  // namespace orca::graph
