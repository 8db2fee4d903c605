// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "matrix.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/objects/covariance.hpp"

namespace orca {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix6 = geometry::Square<6>;

// Closer to straight up or down than this, the covariance of roll and yaw is meaningless.
constexpr double kLeastCosOfPitch = 1e-6;

Vector3d vector_of(const idl::Point& point) { return {point.x(), point.y(), point.z()}; }

Matrix3d matrix_of(const idl::Rotation3D& r) {
  const auto [cr, sr] = portable::cos_sin(r.roll());
  const auto [cp, sp] = portable::cos_sin(r.pitch());
  const auto [cy, sy] = portable::cos_sin(r.yaw());
  Matrix3d about_x, about_y, about_z;
  about_x << 1, 0, 0, 0, cr, -sr, 0, sr, cr;
  about_y << cp, 0, sp, 0, 1, 0, -sp, 0, cp;
  about_z << cy, -sy, 0, sy, cy, 0, 0, 0, 1;
  return about_z * about_y * about_x;
}

// Computes roll, pitch and yaw of a rotation. Straight up or down, roll and yaw are both expressed as roll,
// and the rotation is still correct.
idl::Rotation3D angles_of(const Matrix3d& R) {
  const double yaw = portable::atan2(R(1, 0), R(0, 0));
  const auto [c, s] = portable::cos_sin(yaw);
  idl::Rotation3D rotation;
  rotation.yaw(wrapped(yaw));
  rotation.pitch(portable::atan2(-R(2, 0), c * R(0, 0) + s * R(1, 0)));
  rotation.roll(wrapped(portable::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1))));
  return rotation;
}

// Returns the matrix that maps small changes of roll, pitch and yaw to the small turn about the axes of the
// outer frame. Its columns are the axes that the three turn about.
Matrix3d turn_of_angles(const idl::Rotation3D& r) {
  const auto [cp, sp] = portable::cos_sin(r.pitch());
  const auto [cy, sy] = portable::cos_sin(r.yaw());
  Matrix3d E;
  E << cy * cp, -sy, 0, sy * cp, cy, 0, -sp, 0, 1;
  return E;
}

Matrix3d cross(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Maps (position, roll, pitch, yaw) to (position, turn), the coordinates in which poses compose simply.
Matrix6 to_turn(const idl::Rotation3D& r) {
  Matrix6 J = Matrix6::Identity();
  J.bottomRightCorner<3, 3>() = turn_of_angles(r);
  return J;
}

// Builds a pose whose covariance is given for (position, turn).
Result<idl::Pose3D> pose_of(const Vector3d& position, const Matrix3d& R, const Matrix6& covariance) {
  idl::Pose3D pose;
  pose.position(make_point(position.x(), position.y(), position.z()));
  pose.rotation(angles_of(R));
  if (covariance.isZero(0.0)) return pose;
  if (portable::cos(pose.rotation().pitch()) < kLeastCosOfPitch) {
    return fail(
        Code::failed_precondition,
        "the pose points straight up or down, where the covariance of roll and yaw does not exist; give "
        "poses without covariance, or turn the frame");
  }
  Matrix6 J = Matrix6::Identity();
  J.bottomRightCorner<3, 3>() = turn_of_angles(pose.rotation()).inverse();
  geometry::store<6>(J * covariance * J.transpose(), pose.covariance());
  return pose;
}

Result<idl::Pose3D> with_stamp(Result<idl::Pose3D> pose, std::int64_t ns) {
  if (pose) pose->stamp().ns(ns);
  return pose;
}

}  // namespace

Result<idl::Pose3D> compose(const idl::Pose3D& X_AB, const idl::Pose3D& X_BC) {
  const Matrix3d R_AB = matrix_of(X_AB.rotation());
  const Vector3d p_BC_A = R_AB * vector_of(X_BC.position());
  Matrix6 for_AB = Matrix6::Identity();
  for_AB.topRightCorner<3, 3>() = -cross(p_BC_A);
  for_AB *= to_turn(X_AB.rotation());
  Matrix6 for_BC = Matrix6::Zero();
  for_BC.topLeftCorner<3, 3>() = R_AB;
  for_BC.bottomRightCorner<3, 3>() = R_AB;
  for_BC *= to_turn(X_BC.rotation());
  const Matrix6 covariance = for_AB * geometry::matrix_of<6>(X_AB.covariance()) * for_AB.transpose() +
                             for_BC * geometry::matrix_of<6>(X_BC.covariance()) * for_BC.transpose();
  return with_stamp(
      pose_of(vector_of(X_AB.position()) + p_BC_A, R_AB * matrix_of(X_BC.rotation()), covariance),
      std::max(X_AB.stamp().ns(), X_BC.stamp().ns()));
}

Result<idl::Pose3D> inverse(const idl::Pose3D& X_AB) {
  const Matrix3d R_BA = matrix_of(X_AB.rotation()).transpose();
  const Vector3d p_AB_B = R_BA * vector_of(X_AB.position());
  // The turn of the inverse is the turn the other way, in the other frame.
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = -R_BA;
  J.topRightCorner<3, 3>() = -cross(p_AB_B) * R_BA;
  J.bottomRightCorner<3, 3>() = -R_BA;
  J *= to_turn(X_AB.rotation());
  return with_stamp(pose_of(-p_AB_B, R_BA, J * geometry::matrix_of<6>(X_AB.covariance()) * J.transpose()),
                    X_AB.stamp().ns());
}

}  // namespace orca
