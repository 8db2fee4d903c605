// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "covariance.hpp"
#include "orca/geometry/pose.hpp"

namespace orca {
namespace {

using geometry::matrix_of;
using Matrix = geometry::Square<3>;

}  // namespace

double wrapped_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

idl::Pose2D compose(const idl::Pose2D& X_AB, const idl::Pose2D& X_BC) {
  const double c = std::cos(X_AB.orientation());
  const double s = std::sin(X_AB.orientation());
  const double dx = c * X_BC.x() - s * X_BC.y();  // From B to C, in A.
  const double dy = s * X_BC.x() + c * X_BC.y();
  Matrix for_AB;
  for_AB << 1, 0, -dy, 0, 1, dx, 0, 0, 1;
  Matrix for_BC;
  for_BC << c, -s, 0, s, c, 0, 0, 0, 1;

  idl::Pose2D X_AC;
  X_AC.x(X_AB.x() + dx);
  X_AC.y(X_AB.y() + dy);
  X_AC.orientation(wrapped_angle(X_AB.orientation() + X_BC.orientation()));
  X_AC.stamp().ns(std::max(X_AB.stamp().ns(), X_BC.stamp().ns()));
  geometry::store<3>(for_AB * matrix_of<3>(X_AB.covariance()) * for_AB.transpose() +
                         for_BC * matrix_of<3>(X_BC.covariance()) * for_BC.transpose(),
                     X_AC.covariance());
  return X_AC;
}

idl::Pose2D inverse(const idl::Pose2D& X_AB) {
  const double c = std::cos(X_AB.orientation());
  const double s = std::sin(X_AB.orientation());
  idl::Pose2D X_BA;
  X_BA.x(-c * X_AB.x() - s * X_AB.y());
  X_BA.y(s * X_AB.x() - c * X_AB.y());
  X_BA.orientation(wrapped_angle(-X_AB.orientation()));
  X_BA.stamp(X_AB.stamp());
  Matrix for_AB;
  for_AB << -c, -s, X_BA.y(), s, -c, -X_BA.x(), 0, 0, -1;
  geometry::store<3>(for_AB * matrix_of<3>(X_AB.covariance()) * for_AB.transpose(), X_BA.covariance());
  return X_BA;
}

}  // namespace orca
