// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca {

/// A point or a vector in the plane, in the frame that its user names: x forward (on a plan: to the right), y to the
/// left (on a plan: up). Points are in metres, axes have the length 1.
///
/// A plain value, like all types of src/geometry; its functions may be called from any thread.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

[[nodiscard]] constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
[[nodiscard]] constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// Returns the z component of the cross product: positive if `b` lies to the left of `a`.
[[nodiscard]] constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// Returns the length. It overflows beyond 1e154 and vanishes below 1e-162, where portable::hypot() does not.
[[nodiscard]] inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }

/// Returns a vector of the same direction that is not longer than `longest`.
[[nodiscard]] inline Vec2 shortened(Vec2 a, double longest) {
  const double length = norm(a);
  return length > longest ? (longest / length) * a : a;
}

/// Returns the unit vector at `angle` [rad], counter-clockwise from x.
[[nodiscard]] inline Vec2 direction(double angle) {
  const auto [cosine, sine] = portable::cos_sin(angle);
  return {cosine, sine};
}

/// Turns `a` by the angle that turns the x axis into the unit vector `x_axis`.
[[nodiscard]] constexpr Vec2 rotated(Vec2 a, Vec2 x_axis) {
  return {x_axis.x * a.x - x_axis.y * a.y, x_axis.y * a.x + x_axis.x * a.y};
}
/// Turns `a` by `angle` [rad], counter-clockwise.
[[nodiscard]] inline Vec2 rotated(Vec2 a, double angle) { return rotated(a, direction(angle)); }

}  // namespace orca
