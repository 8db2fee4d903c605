// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

#include "orca/geometry/vec2.hpp"
#include "orca/image/colour.hpp"

namespace orca::sim {

inline constexpr Colour kPlainColour{196, 192, 184};  ///< Of walls and furniture.
inline constexpr Colour kClothes{72, 78, 96};         ///< Of people.
inline constexpr Colour kCasing{150, 152, 156};       ///< Of robots.

/// A directed edge; where it bounds something solid, the solid lies to its left.
struct Segment {
  Vec2 a;
  Vec2 b;
  friend bool operator==(const Segment&, const Segment&) = default;
};

/// A circle in the plane.
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
