// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include "orca/geometry/twist2.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/navigation/footprint.hpp"

namespace orca::avoid {

using nav::Footprint;

/// Returns the distance [m] of the outline's farthest point from the origin.
[[nodiscard]] double reach(const Footprint& body);

/// Returns the outline with `margin` [m] more on all sides. The corners stay corners, so these keep up to 1.4 times as much.
[[nodiscard]] Footprint grown(const Footprint& body, double margin);

/// Returns the margin [m] with which the outline just touches the point; negative if the point lies within it.
[[nodiscard]] double gap(Vec2 point, const Footprint& body);

/// Returns how fast [m/s] the gap to a point outside the outline grows while the robot moves; negative: it gets smaller.
[[nodiscard]] double gap_rate(Vec2 point, const Twist2& motion, const Footprint& body);

/// Returns how long [s] the robot can move before its outline touches the point; infinity if it never does.
///
/// Exact: at a constant twist the point moves on a circle in the robot's frame, and it touches where this circle first
/// meets the outline.
/// @param point   [m] robot frame, outside the outline.
/// @param motion  forward or at rest, without a sideways part.
[[nodiscard]] double time_to_touch(Vec2 point, const Twist2& motion, const Footprint& body);

/// Returns how long [s] the robot can move before an echo is nearer than the margin [m]; infinity if none ever is.
///
/// An echo that is nearer already is judged by the motion, not by how near it is: 0 if it comes nearer. Errors of the laser would
/// otherwise let the robot come nearer bit by bit. An echo from deep within the body is an error, or the robot itself.
[[nodiscard]] double time_to_margin(Vec2 echo, const Twist2& motion, double margin, const Footprint& body);

/// Returns how long [s] it can move before any of the echoes is; infinity if none ever is.
[[nodiscard]] double time_to_margin(std::span<const Vec2> echoes, const Twist2& motion, double margin,
                                    const Footprint& body);

/// The brakes of a robot.
struct Brakes {
  double deceleration = 0.0;       ///< [m/s2]
  double turn_deceleration = 0.0;  ///< [rad/s2]
};

/// Returns whether the robot can come to rest on the way that it moves in `time` [s]: v <= sqrt(2 v time a), and likewise its turn
/// rate by the angle that it turns on that way. A time below 0 counts as 0.
[[nodiscard]] bool can_stop(const Twist2& motion, double time, const Brakes& brakes);

}  // namespace orca::avoid
