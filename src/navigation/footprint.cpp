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

double Footprint::outer_radius() const {
  if (is_circle()) return radius;
  const double corner = norm({half_length, half_width});
  return radius > 0.0 ? std::min(radius, corner) : corner;
}

double clearance(const Footprint& footprint, Vec2 point) {
  if (footprint.is_circle()) return norm(point) - footprint.radius;
  const Vec2 beyond{std::fabs(point.x) - footprint.half_length, std::fabs(point.y) - footprint.half_width};
  const double inside = std::min(0.0, std::max(beyond.x, beyond.y));
  const double off = inside < 0.0 ? inside : norm({std::max(0.0, beyond.x), std::max(0.0, beyond.y)});
  return footprint.radius > 0.0 ? std::max(off, norm(point) - footprint.radius) : off;
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
  const double before = clearance(footprint, pose, points, kMostClearance);
  double least = std::min(margin, before - kNoNearer);
  Room room{1.0, before};
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const Pose2 there = along_arc(pose, {share * travel.forward, share * travel.left, share * travel.turn});
    const double free = clearance(footprint, there, points, kMostClearance);
    if (free < least) {
      room.share = static_cast<double>(i - 1) / steps;
      return room;
    }
    least = std::max(
        least,
        std::min(margin,
                 free - kNoNearer));  // A thing that was left, or another one, is not come near to again.
    room.clearance = std::min(room.clearance, free);
  }
  return room;
}

}  // namespace orca::nav
