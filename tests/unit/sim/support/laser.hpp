// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orca/sim/world.hpp"
#include "scout.hpp"

namespace orca::sim::test {

/// A laser like the LMS 200 in its mode of 1 degree and 8 m, in the middle of the robot.
inline LaserScanner lms200() {
  LaserScanner laser;
  laser.name = "laser";
  laser.count = 181;
  laser.first_angle = -90.0 * kDegree;
  laser.pitch = 1.0 * kDegree;
  laser.max_range = 8.0;
  laser.quantum = 0.01;
  laser.divergence = 0.25 * kDegree;
  laser.period = std::chrono::milliseconds{100};
  laser.sweep = std::chrono::microseconds{6'660};
  laser.height = 0.3;
  return laser;
}

inline RobotModel scout_with(const LaserScanner& laser) {
  RobotModel model = scout();
  model.lasers = {laser};
  return model;
}

/// The angle of reading `k` in the sensor frame [rad].
inline double angle_of(const LaserScanner& laser, std::size_t k) {
  return laser.first_angle + static_cast<double>(k) * laser.pitch;
}

/// A wall across x = `distance`, 40 m long.
inline WorldModel wall_ahead(double distance) {
  return {"wall", {{"wall", Box{{distance + 0.1, 0, 0}, {0.1, 20}}, 2.5}}, {}};
}

/// Steps until the robot's laser has completed a scan.
inline LaserScan next_scan(World& world, RobotId id) {
  do world.step();
  while (!world.laser(id));
  return *world.laser(id);
}

}  // namespace orca::sim::test
