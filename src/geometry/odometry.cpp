// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/geometry/odometry.hpp"

#include <cmath>

#include "covariance.hpp"
#include "orca/geometry/pose.hpp"

namespace orca {
namespace {

// Below this the series are exact to the last digits, and the quotients are not.
constexpr double kSmall = 0.05;

// Chord per arc that turns by 2 h: sin(h) / h.
double chord_ratio(double h) {
  const double q = h * h;
  return std::abs(h) < kSmall ? 1.0 - q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0)) : std::sin(h) / h;
}

// Its derivative.
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

// The derivatives of (x, y, orientation) for the way and the turn of an arc, and the arc's displacement.
struct Arc {
  double dx;
  double dy;
  double turn;
  Eigen::Matrix<double, 3, 2> slope;
};

Arc arc_of(double way, double turn, double start_orientation) {
  const double h = turn / 2.0;
  const double chord = way * chord_ratio(h);
  const double c = std::cos(start_orientation + h);
  const double s = std::sin(start_orientation + h);
  const double lengthening = way * chord_ratio_slope(h) / 2.0;  // d chord / d turn
  Arc arc{.dx = chord * c, .dy = chord * s, .turn = turn, .slope = {}};
  arc.slope << chord_ratio(h) * c, lengthening * c - arc.dy / 2.0,  //
      chord_ratio(h) * s, lengthening * s + arc.dx / 2.0,           //
      0.0, 1.0;
  return arc;
}

}  // namespace

Result<idl::Pose2D> integrate_arc(const idl::Pose2D& X_WB, const WheelTravel& travel,
                                  const DifferentialBase& base) {
  if (const Status status = check(travel, base); !status.ok()) return status.error();
  const double way = (travel.left + travel.right) / 2.0;
  const Arc arc = arc_of(way, (travel.right - travel.left) / base.track, X_WB.orientation());

  Eigen::Matrix3d for_pose;
  for_pose << 1, 0, -arc.dy, 0, 1, arc.dx, 0, 0, 1;
  Eigen::Matrix2d mixing;  // (way, turn) for (left, right)
  mixing << 0.5, 0.5, -1.0 / base.track, 1.0 / base.track;
  const Eigen::Matrix<double, 3, 2> for_wheels = arc.slope * mixing;
  const Eigen::Vector2d variance(base.left_noise * std::abs(travel.left),
                                 base.right_noise * std::abs(travel.right));

  idl::Pose2D result;
  result.x(X_WB.x() + arc.dx);
  result.y(X_WB.y() + arc.dy);
  result.orientation(wrapped_angle(X_WB.orientation() + arc.turn));
  result.stamp(travel.stamp);
  geometry::store<3>(for_pose * geometry::matrix_of<3>(X_WB.covariance()) * for_pose.transpose() +
                         for_wheels * variance.asDiagonal() * for_wheels.transpose(),
                     result.covariance());
  return result;
}

}  // namespace orca
