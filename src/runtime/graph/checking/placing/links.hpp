// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "checking/model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Returns the link that the connection names, else the one that suits the processes of its ends. Reports a link
// that cannot carry it.
Link link_of(const Node& connection, const Edge& edge, const Model& model, Report& report);

}  // namespace orca::graph
