// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/sim/shape.hpp"

namespace orca::sim::detail {

// A convex solid of the plane: all points that are at most `radius` away from the convex polygon through
// `corners`. One corner makes a circle, two make a wall without thickness, more stand counter-clockwise.
struct Rounded {
  std::vector<Vec2> corners;
  double radius = 0.0;  // [m]
};

// Returns the convex solids that together have the outline of a shape: a circle or box as it is, an outline as its
// edges. An outline is hollow so, which does no harm to what stays outside.
[[nodiscard]] std::vector<Rounded> solids_of(const Shape& shape);
// Returns a convex shape as one solid. @pre  an outline is convex and counter-clockwise.
[[nodiscard]] Rounded solid_of(const Shape& shape);

// Puts the corners of a solid, given in the frame of a body at `X_WB`, into the world's frame.
void place(const Rounded& solid, const Pose2& X_WB, Rounded& placed);

// How far two solids are apart.
struct Gap {
  double distance = 0.0;  // [m] Negative if they overlap: then the way along the normal that separates them.
  Vec2 normal;            // Unit vector from the other to the one, along which they are that far apart.
  Vec2 on_one, on_other;  // Their closest points.
};

// Returns the exact gap between two solids, in their common frame.
[[nodiscard]] Gap gap_between(const Rounded& one, const Rounded& other);

// Adds the places where two solids are at most `limit` [m] apart: the closest points, and each corner of one that
// is so close to the other. Two straight sides that lie on each other touch at two places.
void add_touches(const Rounded& one, const Rounded& other, double limit, std::vector<Gap>& touches);

}  // namespace orca::sim::detail
