// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/goals/target.hpp"

namespace orca::go {

struct Limits {
  double max_speed = 0.0;      ///< [m/s]
  double slow_down = 0.0;      ///< [1/s] speed per metre that is left, near the goal.
  double min_speed = 0.0;      ///< [m/s] near the goal.
  double turn_in_place = 0.0;  ///< [rad] at larger directions the robot turns before it drives.
  double deceleration = 0.0;   ///< [m/s2] with which it comes to rest at a goal.
  double circle_radius = 0.0;  ///< [m] of the circle around a place that is never reached.
  bool slides = false;         ///< Whether the base can move sideways.
};

/// Computes one control step towards a target. The robot drives straight at it, slower near a goal and when
/// the target lies off the robot's axis. Within reach it decelerates evenly to rest, then turns to the
/// target's orientation. It may drift out of reach meanwhile, by at most half the reach_radius; but then it
/// approaches once more before it has reached the target. It circles counter-clockwise around a target
/// without reach.
///
/// A robot that slides moves straight at the target however it stands, and turns meanwhile: to the target's orientation, or
/// without one to where it drives.
[[nodiscard]] Step step_towards(const Target& target, const Pose2& pose, const Limits& limits,
                                const Before& before);

}  // namespace orca::go
