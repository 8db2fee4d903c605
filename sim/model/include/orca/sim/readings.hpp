// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::sim {

// Sensors sit in the frame B that the robot's file describes. On most robots that is the robot's frame R. The
// body of a synchro base stays behind when the wheels, and with them R, turn; a turret turns too. X_RB is
// where B was in R, of the body or of the turret, whichever carries the sensor.

/// What one sonar transducer measured.
struct SonarReading {
  std::size_t transducer = 0;  ///< Its number in the ring.
  TimePoint stamp;             ///< When it fired.
  Pose2 sensor;                ///< Where it sat and looked when it fired, in the robot's frame.
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
  Pose2 X_RB;                  ///< See above; at the stamp.
};

/// What the sensors of an infrared ring measured, all at once.
struct InfraredScan {
  TimePoint stamp;
  std::vector<double> ranges;  ///< [m] One per sensor; the ring's max_range: nothing is near.
  Pose2 X_RB;                  ///< See above; at the stamp.
};

/// What a bumper felt since its last reading.
struct BumperReading {
  TimePoint stamp;
  std::vector<bool> pressed;  ///< One per segment.
  Pose2 X_RB;                 ///< See above; at the stamp.
};

/// What the wheel encoders tell: a pose that starts at zero where the robot was set down.
struct OdometryReading {
  TimePoint stamp;
  Pose2 pose;  ///< In the odometry frame.
  Twist2 velocity;
};

/// Where a turret points.
struct TurretReading {
  TimePoint stamp;
  double angle = 0.0;      ///< [rad] In the robot's frame, in (-pi, pi].
  double turn_rate = 0.0;  ///< [rad/s] Relative to the robot's frame.
};

/// A robot began to touch something.
struct ContactEvent {
  std::string robot;
  TimePoint time;
  std::string other;   ///< Name of the obstacle or of the other robot.
  double speed = 0.0;  ///< [m/s] The robot's speed just before.
};

}  // namespace orca::sim
