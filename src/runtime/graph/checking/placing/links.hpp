// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "checking/model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Returns the link that the connection names, else the one that suits the processes of its ends. Reports a link
// that cannot carry it.
Link link_of(const Node& connection, const Edge& edge, const Model& model, Report& report);

// Reports ports that push to more connections by DDS than one can serve.
void check_room_for_dds(const std::vector<Edge>& edges, Report& report);

}  // namespace orca::graph
