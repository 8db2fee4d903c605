// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/sim/geometry.hpp"

// The closed forms of a ray against an edge and a circle; both write the nearest distance if it is below
// `best`.
namespace orca::sim::detail {

// A ray that passes an end, or starts behind a surface, by less than this [m] still meets it.
inline constexpr double kTouch = 1e-9;

// True if the ray o + t u, |u| = 1, meets the edge at some t in [0, best); `best` becomes that t.
inline bool meet(Vec2 o, Vec2 u, const Segment& edge, double& best) {
  const Vec2 d = edge.b - edge.a;
  const Vec2 w = edge.a - o;
  const double slope = cross(u, d);
  if (slope == 0.0) return false;
  const double t = cross(w, d) / slope;
  if (!(t >= -kTouch) || t >= best) return false;
  const double s = cross(w, u) / slope;
  const double margin = kTouch / (std::fabs(d.x) + std::fabs(d.y));
  if (s < -margin || s > 1.0 + margin) return false;
  // At grazing incidence t is badly conditioned, but the edge's ends bound it.
  const double ta = dot(w, u);
  const double tb = dot(edge.b - o, u);
  const double clamped = std::fmin(std::fmax(t, std::fmin(ta, tb) - kTouch), std::fmax(ta, tb) + kTouch);
  if (clamped >= best || clamped < -kTouch) return false;
  best = std::fmax(clamped, 0.0);
  return true;
}

inline bool meet(Vec2 o, Vec2 u, const Circle& circle, double& best) {
  const Vec2 w = circle.center - o;
  const double across = cross(u, w);
  const double rest = circle.radius * circle.radius - across * across;
  if (rest < 0.0) return false;
  const double along = dot(w, u);
  const double half = std::sqrt(rest);
  const double t = along - half >= -kTouch ? along - half : along + half;
  if (!(t >= -kTouch) || t >= best) return false;
  best = std::fmax(t, 0.0);
  return true;
}

}  // namespace orca::sim::detail
