// SPDX-License-Identifier: LGPL-3.0-or-later
#include "footprint.hpp"

#include <algorithm>
#include <utility>

#include "model/part_frame.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/sim/sections.hpp"

namespace orca::sim {
namespace {

constexpr double kOnAxis = 1e-9;
constexpr int kCorners = 24;

// Returns corner `i` of a regular polygon around, not inside, the circle.
Vec2 around_circle(double radius, int i) {
  const double outer = radius / portable::cos(std::numbers::pi / kCorners);
  return outer * direction(2.0 * std::numbers::pi * i / kCorners);
}

std::vector<Vec3> own_points(const Part& part) {
  std::vector<Vec3> points;
  if (const auto* b = std::get_if<Part::Block>(&part.form)) {
    for (int i = 0; i < 8; ++i)
      points.push_back(
          {(i & 1 ? 0.5 : -0.5) * b->x, (i & 2 ? 0.5 : -0.5) * b->y, (i & 4 ? 0.5 : -0.5) * b->z});
  } else if (const auto* c = std::get_if<Part::Cylinder>(&part.form)) {
    for (int i = 0; i < kCorners; ++i) {
      const Vec2 p = around_circle(c->radius, i);
      points.push_back({p.x, p.y, -0.5 * c->length});
      points.push_back({p.x, p.y, 0.5 * c->length});
    }
  } else if (const auto* hull = std::get_if<Part::Hull>(&part.form)) {
    points = hull->corners;
  }
  return points;
}

void add_plan(const Part& part, std::vector<Vec2>& plan) {
  if (const auto* ball = std::get_if<Part::Ball>(&part.form))
    for (int i = 0; i < kCorners; ++i)
      plan.push_back(Vec2{part.X_BP.x, part.X_BP.y} + around_circle(ball->radius, i));
  const detail::PartFrame frame(part.X_BP);
  for (const Vec3& p : own_points(part)) {
    const Vec3 b = frame.in_base(p);
    plan.push_back({b.x, b.y});
  }
}

// Returns true if the circle of that radius around the origin holds the plan of the part.
bool lies_within(double radius, const Part& part) {
  const double own = detail::round_radius(part, {});
  if (own >= 0.0) return own <= radius;
  std::vector<Vec2> plan;
  add_plan(part, plan);
  return std::ranges::all_of(plan, [&](Vec2 p) { return norm(p) <= radius; });
}

}  // namespace

double detail::round_radius(const Part& part, Vec2 center) {
  const Pose3& X = part.X_BP;
  if (portable::hypot(X.x - center.x, X.y - center.y) > kOnAxis) return -1.0;
  if (const auto* ball = std::get_if<Part::Ball>(&part.form)) return ball->radius;
  const auto* cylinder = std::get_if<Part::Cylinder>(&part.form);
  const bool upright = portable::hypot(X.qx, X.qy) < kOnAxis || portable::hypot(X.qz, X.qw) < kOnAxis;
  return cylinder != nullptr && upright ? cylinder->radius : -1.0;
}

Shape footprint_of(const std::vector<Part>& parts) {
  double radius = 0.0;
  for (const Part& p : parts) radius = std::max(radius, detail::round_radius(p, {}));
  if (std::ranges::all_of(parts, [&](const Part& p) { return lies_within(radius, p); }))
    return Circle{{0.0, 0.0}, radius};
  std::vector<Vec2> plan;
  for (const Part& p : parts) add_plan(p, plan);
  return outline_of(hull_of(std::move(plan)));
}

std::pair<double, double> height_range_of(const std::vector<Part>& parts) {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), 0.0};
  for (const Part& p : parts) {
    const auto [low, high] = height_range_of(p);
    range = {std::min(range.first, low), std::max(range.second, high)};
  }
  return range;
}

const SonarRing* RobotModel::sonar(std::string_view ring) const {
  const auto found = std::ranges::find(sonars, ring, &SonarRing::name);
  return found == sonars.end() ? nullptr : &*found;
}

}  // namespace orca::sim
