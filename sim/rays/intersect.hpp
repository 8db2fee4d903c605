// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>

#include "orca/geometry/vec2.hpp"
#include "orca/sim/figures.hpp"

// The closed forms for a ray against an edge and against a circle. Both set `best` to the nearest distance if
// that is smaller.
namespace orca::sim::detail {

// A ray that passes an end, or starts behind a surface, by less than this [m] still meets it.
inline constexpr double kTouch = 1e-9;

// Returns true if the ray o + t u, |u| = 1, meets the edge at some t in [0, best), and sets `best` to that t
// [m].
inline bool meet(Vec2 o, Vec2 u, const Segment& edge, double& best) {
  const Vec2 a = edge.a - o;
  const Vec2 b = edge.b - o;
  // The distances of the two ends to the left of the ray. Most edges lie wholly on one side. Those need no
  // division, and only one branch, because the side cannot be predicted.
  const double left_a = cross(u, a);
  const double left_b = cross(u, b);
  const bool on_left = (left_a > kTouch) & (left_b > kTouch);
  const bool on_right = (left_a < -kTouch) & (left_b < -kTouch);
  if (on_left | on_right | (left_a == left_b)) return false;
  // Keeps the crossing between the ends, even if it is badly conditioned at grazing incidence.
  const double share = std::min(std::max(left_a / (left_a - left_b), 0.0), 1.0);
  const double along_a = dot(u, a);
  const double t = along_a + share * (dot(u, b) - along_a);
  if (!(t >= -kTouch) || t >= best) return false;
  best = std::max(t, 0.0);
  return true;
}

inline bool meet(Vec2 o, Vec2 u, const Circle& circle, double& best) {
  const Vec2 w = circle.center - o;
  const double across = cross(u, w);
  const double rest = (circle.radius - across) * (circle.radius + across);
  if (rest < 0.0) return false;
  const double along = dot(w, u);
  const double half = std::sqrt(rest);
  const double t = along - half >= -kTouch ? along - half : along + half;
  if (!(t >= -kTouch) || t >= best) return false;
  best = std::max(t, 0.0);
  return true;
}

}  // namespace orca::sim::detail
