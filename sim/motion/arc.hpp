// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/sim/geometry.hpp"

// Exact motion at constant velocity in the own frame: a circular arc. A body that goes an arc of length s
// while it turns by a ends s sin(a/2)/(a/2) away; seen from the frame half way, turned by a/2, it went that
// far in the direction of its velocity.
namespace orca::sim::detail {

// How far a body has moved in its own frame.
struct Travel {
  double forward = 0.0;  // [m]
  double left = 0.0;     // [m]
  double turn = 0.0;     // [rad]
};

// Chord length over arc length.
inline double chord_ratio(double turn) {
  const double half = 0.5 * turn;
  // Below 1e-4 the next term of the series is under 1e-17.
  return std::fabs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
}

// The straight way in the world from `yaw` on.
inline Vec2 chord(double yaw, const Travel& travel) {
  return chord_ratio(travel.turn) * rotated({travel.forward, travel.left}, yaw + 0.5 * travel.turn);
}

inline Pose2 along_arc(const Pose2& pose, const Travel& travel) {
  const Vec2 end = pose.position() + chord(pose.yaw, travel);
  return {end.x, end.y, wrapped(pose.yaw + travel.turn)};
}

// What along_arc() was told, from where it began and ended. @pre  it turned by less than half a circle.
inline Travel arc_between(const Pose2& from, const Pose2& to) {
  const double turn = wrapped(to.yaw - from.yaw);
  const Vec2 way = rotated(to.position() - from.position(), -(from.yaw + 0.5 * turn));
  return {way.x / chord_ratio(turn), way.y / chord_ratio(turn), turn};
}

}  // namespace orca::sim::detail
