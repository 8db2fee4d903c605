// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "orca/graph/graph.hpp"
#include "orca/host/run_result.hpp"

namespace orca::host {

/// Finds out which component serves which robot: a component belongs to the robot whose hardware is the fewest
/// connections away, in either direction. With two equally near it belongs to none.
///
/// @param robot_of_hardware  names of the robots, by their hardware in the graph; other hardware is no robot.
/// @thread  pure function; any thread.
[[nodiscard]] RobotNames find_robots(const graph::Graph& graph,
                                     const std::map<std::string, std::string>& robot_of_hardware);

}  // namespace orca::host
