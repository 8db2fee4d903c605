// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <variant>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/figures.hpp"

namespace orca::sim {

/// A rectangle with a centre and a heading; `half` holds half its lengths along its own axes [m].
struct Box {
  Pose2 pose;
  Vec2 half;
};

/// An area given by its closed boundary: edges with the solid to their left, in any order. Holes and several
/// pieces are allowed; a point is inside if a ray from it crosses an odd number of edges.
struct Outline {
  std::vector<Segment> edges;
};

/// A solid area of the plane. A plain value.
using Shape = std::variant<Circle, Box, Outline>;

/// Returns the closed outline through `corners`, turned counter-clockwise.
[[nodiscard]] Outline outline_of(std::vector<Vec2> corners);

/// Returns the corners of the convex hull, counter-clockwise.
[[nodiscard]] std::vector<Vec2> hull_of(std::vector<Vec2> points);

/// Returns the boundary as edges; none for a circle, which has no edges.
[[nodiscard]] std::vector<Segment> edges_of(const Shape& shape);

/// Returns in the world frame a shape that is given in the frame of a body at `X_WB`.
[[nodiscard]] Shape placed(const Shape& shape, const Pose2& X_WB);

[[nodiscard]] Bounds bounds_of(const Shape& shape);

/// Returns true if `p` lies inside. The result is unspecified for a point on the boundary.
[[nodiscard]] bool contains(const Shape& shape, Vec2 p);

/// Returns the distance from `p` to the shape [m]; 0 inside.
[[nodiscard]] double distance(const Shape& shape, Vec2 p);

/// Returns the point of the segment nearest to `p`.
[[nodiscard]] Vec2 nearest_point(const Segment& segment, Vec2 p);

/// Returns true if the two cross, each between the other's ends.
[[nodiscard]] bool cross_each_other(const Segment& one, const Segment& other);

/// Returns true if the two solids share a point.
[[nodiscard]] bool overlap(const Shape& one, const Shape& other);

}  // namespace orca::sim
