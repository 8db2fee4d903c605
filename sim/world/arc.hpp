// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/sim/geometry.hpp"

// Exact motion on a circular arc. A body that goes an arc of length s while it turns by a ends s
// sin(a/2)/(a/2) away, in the direction of its heading half way.
namespace orca::sim::detail {

// Chord length over arc length.
inline double chord_ratio(double turn) {
  const double half = 0.5 * turn;
  // Below 1e-4 the next term of the series is under 1e-17.
  return std::fabs(half) < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
}

inline Pose2 along_arc(const Pose2& pose, double travel, double turn) {
  const Vec2 chord = travel * chord_ratio(turn) * direction(pose.yaw + 0.5 * turn);
  return {pose.x + chord.x, pose.y + chord.y, wrapped(pose.yaw + turn)};
}

}  // namespace orca::sim::detail
