// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "orca/robots/characteristics.hpp"
#include "orca/sim/shape.hpp"

namespace orca::sim {

using robots::BumperRing;
using robots::DeviceLabel;
using robots::Drive;
using robots::DriveKind;
using robots::Guesses;
using robots::InfraredRing;
using robots::LaserScanner;
using robots::Odometer;
using robots::Part;
using robots::Pose3;
using robots::SonarRing;
using robots::Turret;

/// The description of a type of robot for the simulation: what its file gives, and the outline of its body. A plain value; see
/// read_robot().
struct RobotModel : robots::Characteristics {
  Shape footprint;      ///< The parts' plan in the base frame: a circle or a convex outline.
  double bottom = 0.0;  ///< [m] Lowest point of the parts.
  double top = 0.0;     ///< [m] Highest point of the parts.

  /// Returns what a sensor at that height sees of the robot: the convex plans of its parts at that height, in
  /// the base frame; empty if nothing is solid there. See sections_at().
  /// @param height  [m] height above the floor.
  [[nodiscard]] std::vector<Shape> section_at(double height) const;
};

/// Returns the plan of the parts. It is a circle if a ball or an upright cylinder centred on the z axis holds the plan
/// of all others; else it is the convex hull, where a round part counts as the polygon with 24 corners around it.
[[nodiscard]] Shape footprint_of(const std::vector<Part>& parts);

/// Returns the heights of the lowest (first) and highest (second) point of the parts [m].
[[nodiscard]] std::pair<double, double> height_range_of(const std::vector<Part>& parts);

}  // namespace orca::sim
