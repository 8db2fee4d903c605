// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/geometry/angle.hpp"
#include "orca/geometry/vec2.hpp"

namespace orca {

/// The pose of one frame in another, in the plane. X_AB is the pose of frame B in A, p_B a point given in B.
///
/// A plain value.
struct Pose2 {
  double x = 0.0;    ///< [m] of the frame's origin.
  double y = 0.0;    ///< [m] of the frame's origin.
  double yaw = 0.0;  ///< [rad] of its x axis, counter-clockwise from the x axis of the other frame.
  [[nodiscard]] constexpr Vec2 position() const { return {x, y}; }
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// Returns p_A, the point seen from A.
[[nodiscard]] inline Vec2 operator*(const Pose2& X_AB, Vec2 p_B) {
  return X_AB.position() + rotated(p_B, X_AB.yaw);
}

/// Returns X_AC; its yaw is in (-pi, pi].
[[nodiscard]] inline Pose2 operator*(const Pose2& X_AB, const Pose2& X_BC) {
  const Vec2 p = X_AB * X_BC.position();
  return {p.x, p.y, wrapped(X_AB.yaw + X_BC.yaw)};
}

/// Returns X_BA; its yaw is in (-pi, pi].
[[nodiscard]] inline Pose2 inverse(const Pose2& X_AB) {
  const Vec2 p = rotated(-1.0 * X_AB.position(), -X_AB.yaw);
  return {p.x, p.y, wrapped(-X_AB.yaw)};
}

/// Returns p_B, the point seen from B. It equals inverse(X_AB) * p_A with one rounding less.
[[nodiscard]] inline Vec2 seen_from(const Pose2& X_AB, Vec2 p_A) {
  return rotated(p_A - X_AB.position(), -X_AB.yaw);
}

/// Returns X_BC, frame C seen from B; its yaw is in (-pi, pi].
[[nodiscard]] inline Pose2 seen_from(const Pose2& X_AB, const Pose2& X_AC) {
  const Vec2 p = seen_from(X_AB, X_AC.position());
  return {p.x, p.y, wrapped(X_AC.yaw - X_AB.yaw)};
}

}  // namespace orca
