// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rounded.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orca::sim::detail {
namespace {

constexpr double kNothing = 1e-12;  // [m] Below this a direction cannot be told from two points.

Vec2 left_of(Vec2 v) { return {-v.y, v.x}; }

// The edge from one corner to the next. Two corners have an edge there and one back, one corner has a point.
Segment edge(const std::vector<Vec2>& corners, std::size_t k) {
  return {corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]};
}

// Returns the largest coordinate of the corners along `n`, or the smallest.
double reach(const std::vector<Vec2>& corners, Vec2 n) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec2& p : corners) most = std::max(most, dot(n, p));
  return most;
}

// A direction in which two polygons are apart; a negative way tells how deep they are in each other.
struct Axis {
  double apart = -std::numeric_limits<double>::infinity();
  Vec2 normal;  // From the other to the one.
};

// Tries the outward normals of `faces` against `others`. `sign` is -1 if the faces are those of the one.
void try_faces(const std::vector<Vec2>& faces, const std::vector<Vec2>& others, double sign, Axis& best) {
  if (faces.size() < 2) return;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Segment e = edge(faces, k);
    const double length = norm(e.b - e.a);
    if (length < kNothing) continue;
    const Vec2 outward = (-1.0 / length) * left_of(e.b - e.a);
    const double apart = -reach(others, -1.0 * outward) - dot(outward, e.a);
    if (apart > best.apart) best = {apart, sign * outward};
  }
}

// Returns whether a wall without thickness lies beside the others along its own direction.
bool beyond_the_end(const std::vector<Vec2>& wall, const std::vector<Vec2>& others) {
  if (wall.size() != 2) return false;
  const Vec2 along = wall[1] - wall[0];
  return -reach(others, -1.0 * along) > dot(along, wall[1]) || reach(others, along) < dot(along, wall[0]);
}

struct Closest {
  double squared = std::numeric_limits<double>::infinity();
  Vec2 on_one, on_other;
};

// Finds the closest points among the corners of `points` and the edges of `edges`.
void try_corners(const std::vector<Vec2>& points, const std::vector<Vec2>& edges, bool points_are_one,
                 Closest& best) {
  const std::size_t count = edges.size() == 2 ? 1 : edges.size();
  for (const Vec2& p : points)
    for (std::size_t k = 0; k < count; ++k) {
      const Vec2 q = edges.size() == 1 ? edges[0] : nearest_point(edge(edges, k), p);
      const double squared = dot(p - q, p - q);
      if (squared >= best.squared) continue;
      best = points_are_one ? Closest{squared, p, q} : Closest{squared, q, p};
    }
}

Axis deepest(const std::vector<Vec2>& one, const std::vector<Vec2>& other) {
  Axis axis;
  try_faces(one, other, -1.0, axis);
  try_faces(other, one, 1.0, axis);
  return axis;
}

// Returns the gap of two polygons that overlap, or of which one is a point on the other.
Gap overlapping(const Rounded& one, const Rounded& other, const Closest& closest) {
  const Axis axis = deepest(one.corners, other.corners);
  if (!std::isfinite(axis.apart))  // Two points at one place have no direction; any will part them.
    return {-one.radius - other.radius, {1.0, 0.0}, closest.on_one, closest.on_other};
  const Vec2 corner = *std::ranges::min_element(one.corners, {}, [&](Vec2 p) { return dot(p, axis.normal); });
  return {axis.apart - one.radius - other.radius, axis.normal, corner - one.radius * axis.normal,
          corner - (axis.apart - other.radius) * axis.normal};
}

bool apart(const std::vector<Vec2>& one, const std::vector<Vec2>& other) {
  return deepest(one, other).apart > 0.0 || beyond_the_end(one, other) || beyond_the_end(other, one);
}

Gap apart_by(const Closest& closest, const Rounded& one, const Rounded& other) {
  const double distance = std::sqrt(closest.squared);
  const Vec2 normal = (1.0 / distance) * (closest.on_one - closest.on_other);
  return {distance - one.radius - other.radius, normal, closest.on_one - one.radius * normal,
          closest.on_other + other.radius * normal};
}

}  // namespace

std::vector<Rounded> solids_of(const Shape& shape) {
  const auto* const outline = std::get_if<Outline>(&shape);
  if (outline == nullptr) return {solid_of(shape)};
  std::vector<Rounded> walls;
  for (const Segment& e : outline->edges) walls.push_back({{e.a, e.b}, 0.0});
  return walls;
}

Rounded solid_of(const Shape& shape) {
  if (const auto* circle = std::get_if<Circle>(&shape)) return {{circle->center}, circle->radius};
  Rounded solid;
  for (const Segment& e : edges_of(shape)) solid.corners.push_back(e.a);
  return solid;
}

void place(const Rounded& solid, const Pose2& X_WB, Rounded& placed) {
  const Vec2 ahead = direction(X_WB.yaw);
  placed.radius = solid.radius;
  placed.corners.resize(solid.corners.size());
  for (std::size_t k = 0; k < solid.corners.size(); ++k)
    placed.corners[k] = X_WB.position() + rotated(solid.corners[k], ahead);
}

Gap gap_between(const Rounded& one, const Rounded& other) {
  Closest closest;
  try_corners(one.corners, other.corners, true, closest);
  if (one.corners.size() > 1) try_corners(other.corners, one.corners, false, closest);
  const bool points = one.corners.size() == 1 && other.corners.size() == 1;
  if (closest.squared > kNothing * kNothing && (points || apart(one.corners, other.corners)))
    return apart_by(closest, one, other);
  return overlapping(one, other, closest);
}

void add_touches(const Rounded& one, const Rounded& other, double limit, std::vector<Gap>& touches) {
  const Gap closest = gap_between(one, other);
  if (closest.distance > limit) return;
  touches.push_back(closest);
  const auto add = [&](const std::vector<Vec2>& points, const std::vector<Vec2>& edges, bool points_are_one) {
    for (const Vec2& p : points) {
      Closest near;
      try_corners({p}, edges, points_are_one, near);
      if (near.squared <= kNothing * kNothing) continue;
      const Gap gap = apart_by(near, one, other);
      // Only where the two face each other like at the closest point; the rest is the far side of a wall.
      if (gap.distance <= limit && dot(gap.normal, closest.normal) > 0.9 &&
          norm(gap.on_one - closest.on_one) > limit)
        touches.push_back(gap);
    }
  };
  if (closest.distance < 0.0 || one.corners.size() < 2 || other.corners.size() < 2) return;
  add(one.corners, other.corners, true);
  add(other.corners, one.corners, false);
}

}  // namespace orca::sim::detail
