// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/geometry/vec2.hpp"

namespace orca::sim::detail {

// Rays from about one place in about one direction.
struct Cone {
  Cone(Vec2 from, Vec2 towards, double half, double around_tip, double longest)
      : tip(from), axis(towards), half_angle(half), slack(around_tip), reach(longest) {
    const Vec2 rim = direction(half);
    left = rotated(axis, rim);
    right = rotated(axis, Vec2{rim.x, -rim.y});
  }

  Vec2 tip;
  Vec2 axis;          // Of length 1.
  double half_angle;  // [rad] Between the axis and any ray, at most a right angle.
  double slack;       // [m] Between the tip and where any ray starts.
  double reach;       // [m] Of any ray.
  Vec2 left, right;   // Along both rims, of length 1.
};

}  // namespace orca::sim::detail
