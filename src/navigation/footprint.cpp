// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "orca/geometry/arc.hpp"

namespace orca::nav {
namespace {

constexpr double kMostClearance = 1.0;  // [m]
constexpr double kNoNearer = 0.002;     // [m]

}  // namespace

double Footprint::inner_radius() const { return is_circle() ? radius : std::min(half_length, half_width); }

double Footprint::outer_radius() const { return is_circle() ? radius : norm({half_length, half_width}); }

double clearance(const Footprint& footprint, Vec2 point) {
  if (footprint.is_circle()) return norm(point) - footprint.radius;
  const Vec2 beyond{std::fabs(point.x) - footprint.half_length, std::fabs(point.y) - footprint.half_width};
  const double inside = std::min(0.0, std::max(beyond.x, beyond.y));
  return inside < 0.0 ? inside : norm({std::max(0.0, beyond.x), std::max(0.0, beyond.y)});
}

double clearance(const Footprint& footprint, const Pose2& pose, std::span<const Vec2> points, double most) {
  const Vec2 axis = direction(pose.yaw);
  const double reach = footprint.outer_radius() + most;
  double least = most;
  for (const Vec2 point : points) {
    const Vec2 way = point - pose.position();
    if (dot(way, way) > reach * reach) continue;
    least = std::min(least, clearance(footprint, Vec2{dot(axis, way), cross(axis, way)}));
  }
  return least;
}

Room room_along(const Footprint& footprint, const Pose2& pose, const Travel2& travel, int steps,
                std::span<const Vec2> points, double margin) {
  double before = clearance(footprint, pose, points, kMostClearance);
  Room room{1.0, before};
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const Pose2 there = along_arc(pose, {share * travel.forward, share * travel.left, share * travel.turn});
    const double free = clearance(footprint, there, points, kMostClearance);
    if (free < margin && free < before - kNoNearer) {
      room.share = static_cast<double>(i - 1) / steps;
      return room;
    }
    before = std::min(free, std::max(before, margin));
    room.clearance = std::min(room.clearance, free);
  }
  return room;
}

}  // namespace orca::nav
