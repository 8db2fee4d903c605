// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "node.hpp"
#include "orca/graph/laps.hpp"
#include "report.hpp"

namespace orca::graph {

// Returns what a component's attribute `takes` says: a time, or the file of a measurement, which is read. None if it is not given
// or wrong.
LapTime read_lap_time(const Node& component, Report& report);

}  // namespace orca::graph
