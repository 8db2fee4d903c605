// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/sim/robot_model.hpp"

namespace orca::sim {

// Returns a text for each sensor of ranges and each of its heights at which the robot has nothing solid: with that
// sensor two such robots do not see each other. Sensors without a robot have no gaps.
[[nodiscard]] std::vector<std::string> gaps_at_own_sensors(const RobotModel& robot);

}  // namespace orca::sim
