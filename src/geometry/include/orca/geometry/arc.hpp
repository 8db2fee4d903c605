// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Exact motion at a constant twist: an arc of a circle. A body that moves along an arc of length s while it
/// turns by a ends s sin(a/2) / (a/2) away. Seen from the frame halfway, turned by a/2, it has moved that far
/// in the direction of its velocity (docs/geometry.md).
#pragma once

#include <cmath>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca {

/// Returns the ratio of the chord's length to the arc's.
/// @param turn [rad]  from one end of the arc to the other.
[[nodiscard]] inline double chord_ratio(double turn) {
  const double half = 0.5 * turn;
  // Below 1e-4 the next term of the series is under 1e-17.
  return std::fabs(half) < 1e-4 ? 1.0 - half * half / 6.0 : portable::sin(half) / half;
}

/// Returns the straight line from the start of the arc to its end.
/// @param yaw [rad]  of the body at the start, in the frame of the result.
[[nodiscard]] inline Vec2 chord(double yaw, const Travel2& travel) {
  return chord_ratio(travel.turn) * rotated({travel.forward, travel.left}, yaw + 0.5 * travel.turn);
}

/// Returns the pose of a body that has travelled that far from `X_WB`.
[[nodiscard]] inline Pose2 along_arc(const Pose2& X_WB, const Travel2& travel) {
  const Vec2 end = X_WB.position() + chord(X_WB.yaw, travel);
  return {end.x, end.y, wrapped(X_WB.yaw + travel.turn)};
}

/// Returns the pose of a body that has moved at `twist` for `seconds` [s], in its frame at the start.
/// Negative seconds lead back. It equals along_arc({}, twist * seconds) except for the last bits: here the
/// way shrinks to the chord before it is turned, there afterwards. The recorded runs depend on both
/// (docs/adr/0022-one-plane-geometry.md).
[[nodiscard]] inline Pose2 moved(const Twist2& twist, double seconds) {
  const Travel2 travel = twist * seconds;
  const double half = 0.5 * travel.turn;
  Vec2 way{travel.forward, travel.left};
  if (std::fabs(travel.turn) >= 1e-6)
    way = {way.x * portable::sin(half) / half, way.y * portable::sin(half) / half};
  const Vec2 end = rotated(way, half);
  return {end.x, end.y, wrapped(travel.turn)};
}

/// Returns the travel that led along_arc() from `from` to `to`.
/// @pre  the body turned by less than half a circle.
[[nodiscard]] inline Travel2 arc_between(const Pose2& from, const Pose2& to) {
  const double turn = wrapped(to.yaw - from.yaw);
  const Vec2 way = rotated(to.position() - from.position(), -(from.yaw + 0.5 * turn));
  return {way.x / chord_ratio(turn), way.y / chord_ratio(turn), turn};
}

}  // namespace orca
