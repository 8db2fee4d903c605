// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Reports the edges that keep only the latest object although it must wait there for objects of other ports: those
// to the ports of a component whose laps start on objects of one moment.
void check_waiting_room(const Model& model, const std::vector<Edge>& edges, Report& report);

}  // namespace orca::graph
