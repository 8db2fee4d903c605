// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/mesh.hpp"

#include <algorithm>
#include <utility>

namespace orca::sim {
namespace {

double share_at(const Vec3& from, const Vec3& to, double height) {
  return (height - from.z) / (to.z - from.z);
}

Vec3 between(const Vec3& from, const Vec3& to, double height) {
  const double share = share_at(from, to, height);
  return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), height};
}

// Returns the point where the side between two corners, one above the plane and one not, crosses the plane.
// It is always computed from below, so that the two triangles that share the side get the same point, bit for
// bit.
Vec2 crossing(const Vec3& one, const Vec3& other, double height) {
  const Vec3 p = one.z > height ? between(other, one, height) : between(one, other, height);
  return {p.x, p.y};
}

// Adds a triangle's section. The crossing sides are taken in the triangle's own order, so that the solid lies
// to the left of the section.
void add_section(const Triangle& t, double height, std::vector<Segment>& edges) {
  Segment edge;
  bool crossed = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& from = t[i];
    const Vec3& to = t[(i + 1) % 3];
    const bool down = from.z > height && to.z <= height;
    const bool up = from.z <= height && to.z > height;
    if (down) edge.a = crossing(from, to, height);
    if (up) edge.b = crossing(from, to, height);
    crossed = crossed || up;
  }
  if (crossed && !(edge.a == edge.b)) edges.push_back(edge);
}

// Returns the part of a convex polygon where side(corner) >= 0 (Sutherland and Hodgman, Comm. ACM 17(1),
// 1974).
template <class Side>
std::vector<Vec3> clipped(const std::vector<Vec3>& corners, double height, const Side& side) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = corners[i];
    const Vec3& to = corners[(i + 1) % corners.size()];
    if (side(from) >= 0.0) kept.push_back(from);
    if ((side(from) >= 0.0) != (side(to) >= 0.0)) kept.push_back(between(from, to, height));
  }
  return kept;
}

// Returns the plan of the part of a triangle between two heights [m]; fewer than three corners if there is
// none.
std::vector<Vec2> plan_between(const Triangle& t, double bottom, double top) {
  std::vector<Vec3> part(t.begin(), t.end());
  part = clipped(part, bottom, [&](const Vec3& p) { return p.z - bottom; });
  part = clipped(part, top, [&](const Vec3& p) { return top - p.z; });
  std::vector<Vec2> plan;
  for (const Vec3& p : part) plan.push_back({p.x, p.y});
  return plan;
}

Vec2 some_point_of(const Shape& shape) {
  if (const auto* circle = std::get_if<Circle>(&shape)) return circle->center;
  if (const auto* box = std::get_if<Box>(&shape)) return box->pose.position();
  const auto& edges = std::get<Outline>(shape).edges;
  return edges.empty() ? Vec2{} : edges.front().a;
}

}  // namespace

Mesh placed(Mesh mesh, const Vec3& scale, const Pose2& X_WM, double z) {
  for (Triangle& t : mesh.triangles)
    for (Vec3& p : t) {
      const Vec2 plan = X_WM * Vec2{scale.x * p.x, scale.y * p.y};
      p = {plan.x, plan.y, scale.z * p.z + z};
    }
  return mesh;
}

std::pair<double, double> height_range_of(const Mesh& mesh) {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
  for (const Triangle& t : mesh.triangles)
    for (const Vec3& p : t) range = {std::min(range.first, p.z), std::max(range.second, p.z)};
  return range;
}

Outline plan_of(const Mesh& mesh) {
  std::vector<Vec2> points;
  for (const Triangle& t : mesh.triangles)
    for (const Vec3& p : t) points.push_back({p.x, p.y});
  return outline_of(hull_of(std::move(points)));
}

Outline section_of(const Mesh& mesh, double height) {
  Outline section;
  for (const Triangle& t : mesh.triangles) add_section(t, height, section.edges);
  return section;
}

bool overlap(const Mesh& mesh, const Shape& plan, double bottom, double top) {
  const Bounds around = bounds_of(plan);
  for (const Triangle& t : mesh.triangles) {
    const std::vector<Vec2> corners = plan_between(t, bottom, top);
    if (corners.size() < 3) continue;
    const Outline outline = outline_of(corners);
    const Bounds b = bounds_of(outline);
    const bool near = b.low.x <= around.high.x && b.high.x >= around.low.x && b.low.y <= around.high.y &&
                      b.high.y >= around.low.y;
    if (near && overlap(plan, outline)) return true;
  }
  // Either apart or wholly inside.
  const auto [low, high] = height_range_of(mesh);
  const double middle = 0.5 * (std::max(bottom, low) + std::min(top, high));
  return contains(section_of(mesh, middle), some_point_of(plan));
}

}  // namespace orca::sim
