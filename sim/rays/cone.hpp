// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/geometry/vec2.hpp"

namespace orca::sim::detail {

// A bundle of rays from about one place in about one direction.
struct Cone {
  Cone(Vec2 from, Vec2 towards, double half, double around_tip, double longest)
      : tip(from), axis(towards), half_angle(half), slack(around_tip), reach(longest) {
    const Vec2 rim = direction(half);
    left = rotated(axis, rim);
    right = rotated(axis, Vec2{rim.x, -rim.y});
  }

  Vec2 tip;
  Vec2 axis;          // Unit vector.
  double half_angle;  // [rad] Largest angle between the axis and any ray, at most a right angle.
  double slack;       // [m] Largest distance between the tip and the origin of any ray.
  double reach;       // [m] Largest length of any ray.
  Vec2 left, right;   // Directions of both rims, of length 1.
};

}  // namespace orca::sim::detail
