// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/sim/geometry.hpp"

namespace orca::sim {

/// What one sonar transducer measured.
struct SonarReading {
  std::size_t transducer = 0;  ///< Its number in the ring.
  TimePoint stamp;             ///< When it fired.
  Pose2 sensor;                ///< Where it sits and looks, in the robot's base frame.
  double range = 0.0;          ///< [m] Between the ring's min_range and max_range.
  bool echo = false;           ///< False: nothing came back, `range` is max_range.
};

/// One round of a ring, ordered by transducer number.
struct SonarScan {
  std::vector<SonarReading> readings;
};

/// One sweep of a laser.
struct LaserScan {
  TimePoint stamp;             ///< Of the first reading; the last came the scanner's `sweep` later.
  std::vector<double> ranges;  ///< [m] One per beam; the scanner's max_range: nothing came back.
};

/// What the sensors of an infrared ring measured, all at once.
struct InfraredScan {
  TimePoint stamp;
  std::vector<double> ranges;  ///< [m] One per sensor; the ring's max_range: nothing is near.
};

/// What a bumper felt since its last reading.
struct BumperReading {
  TimePoint stamp;
  std::vector<bool> pressed;  ///< One per segment.
};

/// What the wheel encoders tell: a pose that starts at zero where the robot was set down.
struct OdometryReading {
  TimePoint stamp;
  Pose2 pose;  ///< In the odometry frame.
  Velocity velocity;
};

/// A robot began to touch something.
struct ContactEvent {
  std::string robot;
  TimePoint time;
  std::string other;   ///< Name of the obstacle or of the other robot.
  double speed = 0.0;  ///< [m/s] The robot's speed just before.
};

}  // namespace orca::sim
