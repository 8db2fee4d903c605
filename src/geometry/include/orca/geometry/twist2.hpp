// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>

namespace orca {

/// The velocity of a body in the plane, in its own frame.
///
/// A plain value.
struct Twist2 {
  double forward = 0.0;    ///< [m/s] along the body's x axis.
  double left = 0.0;       ///< [m/s] along the body's y axis.
  double turn_rate = 0.0;  ///< [rad/s] about z, positive to the left.
  friend bool operator==(const Twist2&, const Twist2&) = default;
};

[[nodiscard]] inline bool is_finite(const Twist2& twist) {
  return std::isfinite(twist.forward) && std::isfinite(twist.left) && std::isfinite(twist.turn_rate);
}

/// Returns the motion along the same arc at a share [1] of the speed.
[[nodiscard]] constexpr Twist2 operator*(double share, const Twist2& twist) {
  return {share * twist.forward, share * twist.left, share * twist.turn_rate};
}

/// Returns how fast [m/s] the origin of the body's frame moves, in whatever direction.
[[nodiscard]] inline double speed_of(const Twist2& twist) {
  return std::sqrt(twist.forward * twist.forward + twist.left * twist.left);
}

/// The distance that a body travels at a constant twist. The lengths are those of the arc that it follows,
/// not of its chord.
///
/// A plain value.
struct Travel2 {
  double forward = 0.0;  ///< [m]
  double left = 0.0;     ///< [m]
  double turn = 0.0;     ///< [rad] positive to the left; may be more than a whole turn.
  friend bool operator==(const Travel2&, const Travel2&) = default;
};

/// Returns the travel in that time.
/// @param seconds [s]  negative: how far the body has come in the time before.
[[nodiscard]] constexpr Travel2 operator*(const Twist2& twist, double seconds) {
  return {twist.forward * seconds, twist.left * seconds, twist.turn_rate * seconds};
}

/// Returns the constant twist that gives that travel.
/// @pre  seconds is not 0.
[[nodiscard]] constexpr Twist2 operator/(const Travel2& travel, double seconds) {
  return {travel.forward / seconds, travel.left / seconds, travel.turn / seconds};
}

}  // namespace orca
