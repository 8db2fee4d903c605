// SPDX-License-Identifier: LGPL-3.0-or-later
#include "footprint.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace orca::sim {
namespace {

constexpr double kOnAxis = 1e-9;
constexpr int kCorners = 24;

// Returns the columns of the rotation, which are the part's axes in the base frame.
std::array<Vec3, 3> axes_of(const Pose3& q) {
  const double x = q.qx, y = q.qy, z = q.qz, w = q.qw;
  return {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          Vec3{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          Vec3{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

Vec3 in_base(const Pose3& X, const std::array<Vec3, 3>& axes, Vec3 p) {
  return {X.x + axes[0].x * p.x + axes[1].x * p.y + axes[2].x * p.z,
          X.y + axes[0].y * p.x + axes[1].y * p.y + axes[2].y * p.z,
          X.z + axes[0].z * p.x + axes[1].z * p.y + axes[2].z * p.z};
}

// Returns corner `i` of a regular polygon around, not inside, the circle.
Vec2 around_circle(double radius, int i) {
  const double outer = radius / std::cos(std::numbers::pi / kCorners);
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
  const auto axes = axes_of(part.X_BP);
  for (const Vec3& p : own_points(part)) {
    const Vec3 b = in_base(part.X_BP, axes, p);
    plan.push_back({b.x, b.y});
  }
}

std::pair<double, double> hull_heights(const Part& part) {
  const auto axes = axes_of(part.X_BP);
  std::pair<double, double> range{std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
  for (const Vec3& p : own_points(part)) {
    const double z = in_base(part.X_BP, axes, p).z;
    range = {std::min(range.first, z), std::max(range.second, z)};
  }
  return range;
}

std::pair<double, double> part_heights(const Part& part) {
  if (std::holds_alternative<Part::Hull>(part.form)) return hull_heights(part);
  const auto axes = axes_of(part.X_BP);
  double reach = 0.0;
  if (const auto* b = std::get_if<Part::Block>(&part.form))
    reach = 0.5 * (std::fabs(axes[0].z) * b->x + std::fabs(axes[1].z) * b->y + std::fabs(axes[2].z) * b->z);
  if (const auto* c = std::get_if<Part::Cylinder>(&part.form))
    reach = 0.5 * c->length * std::fabs(axes[2].z) + c->radius * std::hypot(axes[0].z, axes[1].z);
  if (const auto* ball = std::get_if<Part::Ball>(&part.form)) reach = ball->radius;
  return {part.X_BP.z - reach, part.X_BP.z + reach};
}

}  // namespace

double detail::round_radius(const Part& part, Vec2 center) {
  const Pose3& X = part.X_BP;
  if (std::hypot(X.x - center.x, X.y - center.y) > kOnAxis) return -1.0;
  if (const auto* ball = std::get_if<Part::Ball>(&part.form)) return ball->radius;
  const auto* cylinder = std::get_if<Part::Cylinder>(&part.form);
  const bool upright = std::hypot(X.qx, X.qy) < kOnAxis || std::hypot(X.qz, X.qw) < kOnAxis;
  return cylinder != nullptr && upright ? cylinder->radius : -1.0;
}

Shape footprint_of(const std::vector<Part>& parts) {
  const bool round =
      std::ranges::all_of(parts, [](const Part& p) { return detail::round_radius(p, {}) >= 0.0; });
  if (round) {
    double radius = 0.0;
    for (const Part& p : parts) radius = std::max(radius, detail::round_radius(p, {}));
    return Circle{{0.0, 0.0}, radius};
  }
  std::vector<Vec2> plan;
  for (const Part& p : parts) add_plan(p, plan);
  return outline_of(hull_of(std::move(plan)));
}

std::pair<double, double> height_range_of(const std::vector<Part>& parts) {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), 0.0};
  for (const Part& p : parts) {
    const auto [low, high] = part_heights(p);
    range = {std::min(range.first, low), std::max(range.second, high)};
  }
  return range;
}

Pose2 SonarRing::transducer(std::size_t k) const {
  const double angle = angles.empty() ? first_angle + static_cast<double>(k) * pitch : angles[k];
  const Vec2 p = positions.empty() ? radius * direction(angle) : positions[k];
  return center * Pose2{p.x, p.y, angle};
}

const SonarRing* RobotModel::sonar(std::string_view ring) const {
  const auto found = std::ranges::find(sonars, ring, &SonarRing::name);
  return found == sonars.end() ? nullptr : &*found;
}

}  // namespace orca::sim
