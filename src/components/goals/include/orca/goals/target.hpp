// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/geometry/pose2.hpp"

namespace orca::go {

/// A goal in the frame of the robot's pose.
struct Target {
  Vec2 place;
  double rise = 0.0;          ///< [m] how far the place lies above the robot, or below.
  double reach_radius = 0.0;  ///< [m] of the ball around the place; 0: never reached, the robot circles it.
  bool use_orientation = false;
  double orientation = 0.0;  ///< [rad] to face there, if use_orientation.
  double reach_angle = 0.0;  ///< [rad] tolerance of that.
  bool via = false;          ///< Only passed: no slowing down.
};

/// The state of the lap before: where the robot was, and what was commanded.
struct Before {
  bool near = false;   ///< It has come within reach and is about to rest there: Step::near of that lap.
  double speed = 0.0;  ///< [m/s] that was commanded.
  double time = 0.0;   ///< [s] since then.
};

/// The result of one lap: a direction in the robot frame and a speed, or the end of the task.
struct Step {
  enum class Kind { drive, turn, reached };
  Kind kind = Kind::drive;
  double direction = 0.0;  ///< [rad] robot frame, counter-clockwise positive, in (-pi, pi].
  double speed = 0.0;      ///< [m/s]
  bool near = false;       ///< The robot comes to rest at the target.
  /// [rad/s] If given, the robot moves in the direction without turning to it, and turns at this rate meanwhile.
  std::optional<double> turn_rate = {};
};

/// Returns whether the pose lies within the target's reach radius.
[[nodiscard]] bool within_reach(const Target& target, const Pose2& pose);

/// Returns the distance from the pose to the target [m], on the floor.
[[nodiscard]] double distance(const Target& target, const Pose2& pose);

/// Computes one control step of a robot that is within reach of its target: it decelerates evenly to rest, then turns to the
/// target's orientation. It may drift out of reach meanwhile, by at most half the reach_radius; but then it must
/// approach once more before it has reached the target.
/// @param deceleration [m/s2]
/// @return nothing if it must still approach.
[[nodiscard]] std::optional<Step> step_of_rest(const Target& target, const Pose2& pose, double deceleration,
                                               const Before& before);

}  // namespace orca::go
