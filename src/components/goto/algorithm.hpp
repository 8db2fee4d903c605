// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::go {

/// Where the robot is, in the frame that the goals are given in.
struct Pose {
  double x = 0.0;        ///< [m]
  double y = 0.0;        ///< [m]
  double heading = 0.0;  ///< [rad]
};

struct Target {
  double x = 0.0;             ///< [m]
  double y = 0.0;             ///< [m]
  double reach_radius = 0.0;  ///< [m] 0: never reached, the robot circles it.
  bool use_orientation = false;
  double orientation = 0.0;  ///< [rad] to face there, if use_orientation.
  double reach_angle = 0.0;  ///< [rad] tolerance of that.
  bool via = false;          ///< Only passed: no slowing down.
};

struct Limits {
  double max_speed = 0.0;      ///< [m/s]
  double slow_down = 0.0;      ///< [1/s] speed per metre that is left, near the goal.
  double min_speed = 0.0;      ///< [m/s] near the goal.
  double turn_in_place = 0.0;  ///< [rad] at larger directions the robot turns before it drives.
};

/// What to do now: a direction in the robot frame and a speed, or nothing more.
struct Step {
  enum class Kind { drive, turn, reached };
  Kind kind = Kind::drive;
  double direction = 0.0;  ///< [rad] robot frame, counter-clockwise positive, in (-pi, pi].
  double speed = 0.0;      ///< [m/s]
};

/// The angle in (-pi, pi] [rad].
[[nodiscard]] double wrap(double angle);

/// One control step towards a target: straight at it, slower when the target lies off the robot's axis and
/// near a goal.
///
/// @param near  whether the robot has been within reach_radius before: then only the orientation is left to
/// do, and
///              a little drift out of the radius does not start the approach again.
[[nodiscard]] Step step_towards(const Target& target, const Pose& pose, const Limits& limits, bool near);

/// Whether the pose lies within the target's reach radius.
[[nodiscard]] bool within_reach(const Target& target, const Pose& pose);

}  // namespace orca::go
