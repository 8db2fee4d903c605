// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "matrix.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"

namespace orca {
namespace {

using geometry::matrix_of;
using Matrix3 = geometry::Square<3>;

idl::Pose2D without_covariance(const Pose2& pose, std::int64_t stamp_ns) {
  idl::Pose2D object;
  object.x(pose.x);
  object.y(pose.y);
  object.orientation(pose.yaw);
  object.stamp().ns(stamp_ns);
  return object;
}

}  // namespace

idl::Pose2D compose(const idl::Pose2D& X_AB, const idl::Pose2D& X_BC) {
  const auto [c, s] = portable::cos_sin(X_AB.orientation());
  const Vec2 d = rotated(plane_pose(X_BC).position(), Vec2{c, s});  // From B to C, in A.
  Matrix3 for_AB;
  for_AB << 1, 0, -d.y, 0, 1, d.x, 0, 0, 1;
  Matrix3 for_BC;
  for_BC << c, -s, 0, s, c, 0, 0, 0, 1;

  idl::Pose2D X_AC =
      without_covariance(plane_pose(X_AB) * plane_pose(X_BC), std::max(X_AB.stamp().ns(), X_BC.stamp().ns()));
  geometry::store<3>(for_AB * matrix_of<3>(X_AB.covariance()) * for_AB.transpose() +
                         for_BC * matrix_of<3>(X_BC.covariance()) * for_BC.transpose(),
                     X_AC.covariance());
  return X_AC;
}

idl::Pose2D inverse(const idl::Pose2D& X_AB) {
  const auto [c, s] = portable::cos_sin(X_AB.orientation());
  idl::Pose2D X_BA = without_covariance(inverse(plane_pose(X_AB)), X_AB.stamp().ns());
  Matrix3 for_AB;
  for_AB << -c, -s, X_BA.y(), s, -c, -X_BA.x(), 0, 0, -1;
  geometry::store<3>(for_AB * matrix_of<3>(X_AB.covariance()) * for_AB.transpose(), X_BA.covariance());
  return X_BA;
}

std::array<double, 9> anywhere() {
  constexpr double kFar = 1e6;  // [m]
  constexpr double kTurned = 2.0 * std::numbers::pi;
  return {kFar * kFar, 0.0, 0.0, 0.0, kFar * kFar, 0.0, 0.0, 0.0, kTurned * kTurned};
}

bool is_anywhere(const std::array<double, 9>& covariance) { return position_deviation(covariance) >= 1e5; }

// The root of the larger eigenvalue of the covariance of x and y.
double position_deviation(const std::array<double, 9>& covariance) {
  const double mean = 0.5 * (covariance[0] + covariance[4]);
  return std::sqrt(
      std::max(0.0, mean + portable::hypot(0.5 * (covariance[0] - covariance[4]), covariance[1])));
}

}  // namespace orca
