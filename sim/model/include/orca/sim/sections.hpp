// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "orca/sim/robot_model.hpp"

namespace orca::sim {

/// Returns the convex plans, in the base frame, of the parts that are solid at a height: at most one per
/// part, in the order of the parts. Each is a Circle or a convex Outline; together they are the robot's section.
///
/// A part is cut where bottom <= height < top, as a sensor sees it. The sections of blocks, hulls, balls,
/// upright cylinders and cylinders whose axis is level are exact. A tilted cylinder counts as the prism with 128
/// sides around it, which is at most 0.04 % of the radius larger.
///
/// @param height  [m] height above the floor.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<Shape> sections_at(const std::vector<Part>& parts, double height);

/// Returns the same for the parts of some links of a robot.
[[nodiscard]] std::vector<Shape> sections_of(const RobotModel& robot, const std::vector<std::string>& links,
                                             double height);

/// Returns the convex plans, in the base frame, of what the parts have between two heights: at most one per
/// part, in the order of the parts. Each is a Circle or a convex Outline, as exact as those of sections_at().
///
/// A part that only touches the range from above or from below is not in it: a robot may stand on what is as high
/// as its underside.
///
/// @param low, high  [m] heights above the floor, low < high; infinite ones are allowed.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<Shape> plans_between(const std::vector<Part>& parts, double low, double high);

/// Returns the heights of the lowest (first) and highest (second) point of a part [m].
[[nodiscard]] std::pair<double, double> height_range_of(const Part& part);

/// Returns true if the part has the same section at each height that it reaches: a block with an upright axis
/// or an upright cylinder.
[[nodiscard]] bool is_upright(const Part& part);

}  // namespace orca::sim
