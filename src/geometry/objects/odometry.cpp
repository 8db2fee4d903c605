// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/geometry/objects/odometry.hpp"

#include <cmath>

#include "matrix.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/plane.hpp"

namespace orca {
namespace {

// Below this [rad] the series is exact to the last digits, but the quotient is not.
constexpr double kSmall = 0.05;

// Returns the derivative of sin(h) / h, the chord per arc that turns by 2 h.
double chord_ratio_slope(double h) {
  const double q = h * h;
  if (std::abs(h) < kSmall) return -h / 3.0 * (1.0 - q / 10.0 * (1.0 - q / 28.0 * (1.0 - q / 54.0)));
  return (std::cos(h) - std::sin(h) / h) / h;
}

Status check(const WheelTravel& travel, const DifferentialBase& base) {
  if (!(base.track > 0.0) || !std::isfinite(base.track)) {
    return fail(Code::invalid_argument,
                "the track is " + std::to_string(base.track) + " m, it must be positive");
  }
  const bool noise = base.left_noise >= 0.0 && base.right_noise >= 0.0;
  if (!noise || !std::isfinite(base.left_noise) || !std::isfinite(base.right_noise)) {
    return fail(Code::invalid_argument, "the wheels' noise must be finite and not negative");
  }
  if (!std::isfinite(travel.left) || !std::isfinite(travel.right)) {
    return fail(Code::invalid_argument, "the wheels' travel must be finite");
  }
  return ok();
}

// Returns the derivatives of (x, y, orientation) with respect to the length and the turn of an arc that ends
// `chord` away.
Eigen::Matrix<double, 3, 2> slope_of(const Travel2& travel, const Vec2& chord, double start_orientation) {
  const double h = 0.5 * travel.turn;
  const Vec2 along = direction(start_orientation + h);
  const double ratio = chord_ratio(travel.turn);
  const double lengthening = travel.forward * chord_ratio_slope(h) / 2.0;  // d chord / d turn
  Eigen::Matrix<double, 3, 2> slope;
  slope << ratio * along.x, lengthening * along.x - chord.y / 2.0,  //
      ratio * along.y, lengthening * along.y + chord.x / 2.0,       //
      0.0, 1.0;
  return slope;
}

}  // namespace

Result<idl::Pose2D> integrate_arc(const idl::Pose2D& X_WB, const WheelTravel& travel,
                                  const DifferentialBase& base) {
  if (const Status status = check(travel, base); !status.ok()) return status.error();
  const Travel2 moved{.forward = (travel.left + travel.right) / 2.0,
                      .turn = (travel.right - travel.left) / base.track};
  const Vec2 way = chord(X_WB.orientation(), moved);
  const Pose2 end = along_arc(plane_pose(X_WB), moved);

  Eigen::Matrix3d for_pose;
  for_pose << 1, 0, -way.y, 0, 1, way.x, 0, 0, 1;
  Eigen::Matrix2d mixing;  // (way, turn) for (left, right)
  mixing << 0.5, 0.5, -1.0 / base.track, 1.0 / base.track;
  const Eigen::Matrix<double, 3, 2> for_wheels = slope_of(moved, way, X_WB.orientation()) * mixing;
  const Eigen::Vector2d variance(base.left_noise * std::abs(travel.left),
                                 base.right_noise * std::abs(travel.right));

  idl::Pose2D result;
  result.x(end.x);
  result.y(end.y);
  result.orientation(end.yaw);
  result.stamp(travel.stamp);
  geometry::store<3>(for_pose * geometry::matrix_of<3>(X_WB.covariance()) * for_pose.transpose() +
                         for_wheels * variance.asDiagonal() * for_wheels.transpose(),
                     result.covariance());
  return result;
}

}  // namespace orca
