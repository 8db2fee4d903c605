// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/shape.hpp"

#include <algorithm>
#include <utility>

namespace orca::sim {
namespace {

double twice_area(const std::vector<Vec2>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += cross(corners[i], corners[(i + 1) % corners.size()]);
  return sum;
}

bool odd_crossings(const std::vector<Segment>& edges, Vec2 p) {
  bool inside = false;
  for (const Segment& e : edges) {
    if ((e.a.y > p.y) == (e.b.y > p.y)) continue;
    const double x = e.a.x + (p.y - e.a.y) / (e.b.y - e.a.y) * (e.b.x - e.a.x);
    if (p.x < x) inside = !inside;
  }
  return inside;
}

double distance_to_edges(const std::vector<Segment>& edges, Vec2 p) {
  double best = std::numeric_limits<double>::infinity();
  for (const Segment& e : edges) best = std::min(best, norm(nearest_point(e, p) - p));
  return best;
}

int side(const Segment& s, Vec2 p) {
  const double c = cross(s.b - s.a, p - s.a);
  return c > 0.0 ? 1 : c < 0.0 ? -1 : 0;
}

bool edges_overlap(const Shape& one, const Shape& other) {
  const std::vector<Segment> a = edges_of(one);
  const std::vector<Segment> b = edges_of(other);
  if (a.empty() || b.empty()) return false;
  if (contains(one, b.front().a) || contains(other, a.front().a)) return true;
  return std::ranges::any_of(a, [&](const Segment& s) {
    return std::ranges::any_of(b, [&](const Segment& t) { return cross_each_other(s, t); });
  });
}

}  // namespace

// Uses Andrew's monotone chain (Inf. Proc. Letters 9(5), 1979).
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  std::ranges::sort(points, [](Vec2 a, Vec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  std::vector<Vec2> hull;
  const auto half = [&hull](const auto& range) {
    const std::size_t base = hull.size();
    for (const Vec2& p : range) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 1e-15)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
  };
  half(points);
  std::ranges::reverse(points);
  half(points);
  return hull;
}

Outline outline_of(std::vector<Vec2> corners) {
  if (twice_area(corners) < 0.0) std::ranges::reverse(corners);
  Outline outline;
  for (std::size_t i = 0; i < corners.size(); ++i)
    outline.edges.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return outline;
}

std::vector<Segment> edges_of(const Shape& shape) {
  if (const auto* outline = std::get_if<Outline>(&shape)) return outline->edges;
  const auto* box = std::get_if<Box>(&shape);
  if (box == nullptr) return {};
  const Vec2 h = box->half;
  return outline_of({box->pose * Vec2{-h.x, -h.y}, box->pose * Vec2{h.x, -h.y}, box->pose * h,
                     box->pose * Vec2{-h.x, h.y}})
      .edges;
}

Shape placed(const Shape& shape, const Pose2& X_WB) {
  if (const auto* circle = std::get_if<Circle>(&shape)) return Circle{X_WB * circle->center, circle->radius};
  if (const auto* box = std::get_if<Box>(&shape)) return Box{X_WB * box->pose, box->half};
  Outline moved = std::get<Outline>(shape);
  const Vec2 ahead = direction(X_WB.yaw);  // Once for all points, because robots are placed in each tick.
  const auto there = [&](Vec2 p) { return X_WB.position() + rotated(p, ahead); };
  for (Segment& e : moved.edges) e = {there(e.a), there(e.b)};
  return moved;
}

Bounds bounds_of(const Shape& shape) {
  Bounds bounds;
  if (const auto* circle = std::get_if<Circle>(&shape)) bounds.add(*circle);
  for (const Segment& e : edges_of(shape)) {
    bounds.add(e.a);
    bounds.add(e.b);
  }
  return bounds;
}

bool contains(const Shape& shape, Vec2 p) {
  if (const auto* circle = std::get_if<Circle>(&shape)) return norm(p - circle->center) < circle->radius;
  return odd_crossings(edges_of(shape), p);
}

double distance(const Shape& shape, Vec2 p) {
  if (const auto* circle = std::get_if<Circle>(&shape))
    return std::max(0.0, norm(p - circle->center) - circle->radius);
  const std::vector<Segment> edges = edges_of(shape);
  return odd_crossings(edges, p) ? 0.0 : distance_to_edges(edges, p);
}

Vec2 nearest_point(const Segment& segment, Vec2 p) {
  const Vec2 along = segment.b - segment.a;
  const double length2 = dot(along, along);
  if (length2 == 0.0) return segment.a;
  return segment.a + std::clamp(dot(p - segment.a, along) / length2, 0.0, 1.0) * along;
}

bool cross_each_other(const Segment& one, const Segment& other) {
  return side(one, other.a) * side(one, other.b) < 0 && side(other, one.a) * side(other, one.b) < 0;
}

bool overlap(const Shape& one, const Shape& other) {
  if (const auto* circle = std::get_if<Circle>(&one)) return distance(other, circle->center) < circle->radius;
  if (const auto* circle = std::get_if<Circle>(&other)) return distance(one, circle->center) < circle->radius;
  return edges_overlap(one, other);
}

}  // namespace orca::sim
