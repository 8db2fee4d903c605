// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>

#include "orca/geometry/vec2.hpp"

// Bearings: numbers that grow with the angle to the left of the x axis. A right angle is 1, half a turn is 2.
// Between, a bearing is no multiple of the angle, but it takes one division and no function of a library, so
// that it is the same on every machine.
namespace orca::sim::detail {

// Returns the bearing of a vector other than zero, from -2 to 2.
inline double bearing_of(Vec2 v) {
  const double side = v.y / (std::fabs(v.x) + std::fabs(v.y));
  return v.x >= 0.0 ? side : std::copysign(2.0, v.y) - side;
}

// Returns a vector with this bearing, from -1 to 1. Its length lies between 0.7 and 1.
inline Vec2 towards(double bearing) { return {1.0 - std::fabs(bearing), bearing}; }

// The directions between two bearings.
struct Stretch {
  double from = 0.0;
  double to = 0.0;
  [[nodiscard]] bool empty() const { return !(from < to); }
  [[nodiscard]] bool holds(double bearing) const { return from <= bearing && bearing <= to; }
};

}  // namespace orca::sim::detail
