// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// What sensors see of a robot: its parts as upright solids. A part with one section at all heights is one solid. Any other is
// cut into slices, each with the section in its middle; at the heights of sensors the section is exact.
class RobotSolids {
 public:
  // @param eyes  [m] heights of sensors above the floor.
  RobotSolids(const RobotModel& robot, const std::set<double>& eyes);

  // Returns the solids of a robot whose base frame is at `X_WB`.
  [[nodiscard]] std::vector<Body> at(const Pose2& X_WB) const;

 private:
  void add_slices(const Part& part, const std::set<double>& eyes);
  void add(Body solid);

  std::vector<Body> solids_;  // In the base frame.
};

// Returns the heights above the floor of a robot's sensors of ranges [m].
[[nodiscard]] std::set<double> sensor_heights(const RobotModel& robot);

}  // namespace orca::sim::detail
