// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/navigation/surface.hpp"

namespace orca::test {

/// A wall between two points.
struct Wall {
  Vec2 from, to;
};
using Walls = std::vector<Wall>;

/// The four walls of a box.
inline Walls box(Vec2 low, Vec2 high) {
  return {{low, {high.x, low.y}}, {{high.x, low.y}, high}, {high, {low.x, high.y}}, {{low.x, high.y}, low}};
}

/// How far it is from `eye` along the unit vector `ahead` to the nearest wall [m].
inline double range(const Walls& walls, Vec2 eye, Vec2 ahead) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) {
    const Vec2 way = wall.to - wall.from;
    const double across = cross(ahead, way);
    if (across == 0.0) continue;
    const double distance = cross(wall.from - eye, way) / across;
    const double place = cross(wall.from - eye, ahead) / across;
    if (distance > 0.0 && place >= 0.0 && place <= 1.0) nearest = std::min(nearest, distance);
  }
  return nearest;
}

/// A scan of 181 beams in front of a laser at the middle of a robot, with noise of `sigma` [m].
inline std::vector<nav::SurfacePoint> scan_of(const Walls& walls, const Pose2& X_WR, double sigma,
                                              RandomStream& random) {
  std::vector<Vec2> points;
  for (int i = -90; i <= 90; ++i) {
    const double angle = i * std::numbers::pi / 180.0;
    const double distance = range(walls, X_WR.position(), direction(X_WR.yaw + angle));
    if (distance < 20.0) points.push_back((distance + random.normal(0.0, sigma)) * direction(angle));
  }
  return nav::surface_of(points, {});
}

/// How far two poses are apart.
struct Apart {
  double way;   ///< [m]
  double turn;  ///< [rad]
};
inline Apart apart(const Pose2& a, const Pose2& b) {
  const Pose2 difference = seen_from(a, b);
  return {norm(difference.position()), std::fabs(difference.yaw)};
}

}  // namespace orca::test
