// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/surface_offset.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace orca::nav {
namespace {

constexpr double kMostOffset = 0.1;  // [m]
constexpr double kDrift = 0.0005;    // [m] by which it may change from scan to scan: another part of the map

// Moves a point away from the sensor.
SurfacePoint moved_back(const SurfacePoint& point, double way) {
  const Vec2 towards =
      point.normal == Vec2{} ? -1.0 / std::max(1e-9, norm(point.at)) * point.at : point.normal;
  return {point.at - way * towards, point.normal};
}

}  // namespace

std::vector<SurfacePoint> SurfaceOffset::corrected(std::span<const SurfacePoint> scan) const {
  std::vector<SurfacePoint> result;
  result.reserve(scan.size());
  for (const SurfacePoint& point : scan) result.push_back(moved_back(point, value_));
  return result;
}

// Least squares of the pose, in the robot's frame, and of the offset.
PoseSpread SurfaceOffset::learn(std::span<const SurfacePoint> scan, const SurfaceMap& map, const Pose2& X_MR,
                                const MatchOptions& options) {
  using Eigen::Matrix3d;
  using Eigen::Matrix4d;
  using Eigen::Vector4d;
  variance_ += kDrift * kDrift;
  // A direction that nothing holds is known to some metres.
  Matrix4d h = Vector4d(0.01, 0.01, 0.1, 1.0 / variance_).asDiagonal();
  Vector4d b = Vector4d::Zero();
  const double scale = 1.0 / (options.error * options.error * options.together);
  for (const SurfacePoint& point : scan) {
    const SurfacePoint* const surface = map.nearest(X_MR * point.at, options.inlier);
    if (surface == nullptr || surface->normal == Vec2{}) continue;
    const Vec2 normal = rotated(surface->normal, -X_MR.yaw);
    if (dot(normal, point.normal) < 0.0) continue;
    const double e = dot(X_MR * point.at - surface->at, surface->normal);
    const Vector4d j(normal.x, normal.y, dot(normal, {-point.at.y, point.at.x}), -1.0);
    const double weight = scale / (1.0 + 9.0 * e * e / (options.inlier * options.inlier));
    h += weight * j * j.transpose();
    b += weight * e * j;
  }
  const Matrix4d covariance = h.inverse();
  const Vector4d step = -covariance * b;
  value_ = std::clamp(value_ + step[3], -kMostOffset, kMostOffset);
  variance_ = covariance(3, 3);
  const Vec2 ahead = direction(X_MR.yaw);
  Matrix3d turn = Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << ahead.x, -ahead.y, ahead.y, ahead.x;
  const Matrix3d seen = turn * covariance.topLeftCorner<3, 3>() * turn.transpose();
  PoseSpread spread{X_MR * Pose2{step[0], step[1], step[2]}, {}};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      spread.covariance[3 * row + column] =
          seen(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
  return spread;
}

}  // namespace orca::nav
