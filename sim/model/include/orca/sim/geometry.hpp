// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace orca::sim {

/// A point or a vector in the plane [m]. World frame: x to the right, y up on a plan, right-handed.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

[[nodiscard]] constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
[[nodiscard]] constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
/// The unit vector at `angle` [rad], counter-clockwise from x.
[[nodiscard]] inline Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
/// Turned as the x axis is to become the unit vector `x_axis`.
[[nodiscard]] constexpr Vec2 rotated(Vec2 a, Vec2 x_axis) {
  return {x_axis.x * a.x - x_axis.y * a.y, x_axis.y * a.x + x_axis.x * a.y};
}
[[nodiscard]] inline Vec2 rotated(Vec2 a, double angle) { return rotated(a, direction(angle)); }

/// The same angle in (-pi, pi] [rad].
[[nodiscard]] inline double wrapped(double angle) {
  const double r = std::remainder(angle, 2.0 * std::numbers::pi);
  return r <= -std::numbers::pi ? std::numbers::pi : r;
}

/// Position [m] and heading [rad, counter-clockwise from x] of one frame in another.
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  [[nodiscard]] Vec2 position() const { return {x, y}; }
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// X_AC from X_AB and X_BC; the yaw is wrapped to (-pi, pi].
[[nodiscard]] inline Pose2 operator*(const Pose2& ab, const Pose2& bc) {
  const Vec2 p = ab.position() + rotated(bc.position(), ab.yaw);
  return {p.x, p.y, wrapped(ab.yaw + bc.yaw)};
}
/// A point given in frame B, expressed in frame A.
[[nodiscard]] inline Vec2 operator*(const Pose2& ab, Vec2 p_b) {
  return ab.position() + rotated(p_b, ab.yaw);
}

/// The pose of A in B from that of B in A.
[[nodiscard]] inline Pose2 inverse(const Pose2& ab) {
  const Vec2 p = rotated(-1.0 * ab.position(), -ab.yaw);
  return {p.x, p.y, wrapped(-ab.yaw)};
}

/// Velocity of a body in its own frame: forward [m/s], turning [rad/s, counter-clockwise], sideways [m/s, to
/// the left].
struct Velocity {
  double forward = 0.0;
  double turn = 0.0;
  double left = 0.0;
  friend bool operator==(const Velocity&, const Velocity&) = default;
};

/// A directed edge; where it bounds something solid, the solid lies to its left.
struct Segment {
  Vec2 a;
  Vec2 b;
  friend bool operator==(const Segment&, const Segment&) = default;
};

struct Circle {
  Vec2 center;
  double radius = 0.0;  ///< [m]
  friend bool operator==(const Circle&, const Circle&) = default;
};

/// An axis-aligned rectangle [m]; empty until a point is added.
struct Bounds {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return low.x > high.x; }
  void add(Vec2 p) {
    low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y)};
    high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y)};
  }
  void add(const Circle& c) {
    add(c.center - Vec2{c.radius, c.radius});
    add(c.center + Vec2{c.radius, c.radius});
  }
};

}  // namespace orca::sim
