// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "orca/base/random.hpp"
#include "orca/geometry/pose.hpp"

namespace orca::test {

/// A pose as a vector of its N numbers, for tests that treat the plane (3) and space (6) alike.
template <int N>
using Vector = Eigen::Matrix<double, N, 1>;
template <int N>
using Matrix = Eigen::Matrix<double, N, N>;

inline Vector<3> vector_of(const idl::Pose2D& pose) { return {pose.x(), pose.y(), pose.orientation()}; }
inline Vector<6> vector_of(const idl::Pose3D& pose) {
  Vector<6> v;
  v << pose.position().x(), pose.position().y(), pose.position().z(), pose.rotation().roll(),
      pose.rotation().pitch(), pose.rotation().yaw();
  return v;
}

inline idl::Pose2D pose_of(const Vector<3>& v) {
  idl::Pose2D pose;
  pose.x(v(0));
  pose.y(v(1));
  pose.orientation(v(2));
  return pose;
}
inline idl::Pose3D pose_of(const Vector<6>& v) {
  idl::Pose3D pose;
  pose.position(make_point(v(0), v(1), v(2)));
  pose.rotation().roll(v(3));
  pose.rotation().pitch(v(4));
  pose.rotation().yaw(v(5));
  return pose;
}

/// b - a; angles the short way round. Angles are the last 1 of 3 and the last 3 of 6.
template <int N>
Vector<N> difference(const Vector<N>& a, const Vector<N>& b) {
  Vector<N> d = b - a;
  for (int i = N / 2 + (N == 3 ? 1 : 0); i < N; ++i) d(i) = wrapped_angle(d(i));
  return d;
}

inline Matrix<3> covariance_of(const idl::Pose2D& pose) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.covariance().data());
}
inline Matrix<6> covariance_of(const idl::Pose3D& pose) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(pose.covariance().data());
}
template <class Pose, int N>
void set_covariance(Pose& pose, const Matrix<N>& covariance) {
  Eigen::Map<Eigen::Matrix<double, N, N, Eigen::RowMajor>>(pose.covariance().data()) = covariance;
}

/// A random vector with independent normal entries.
template <int N>
Vector<N> normal(RandomStream& random, double sigma) {
  Vector<N> v;
  for (int i = 0; i < N; ++i) v(i) = random.normal(0.0, sigma);
  return v;
}

/// A random covariance, none of whose standard deviations is much over `sigma`.
template <int N>
Matrix<N> random_covariance(RandomStream& random, double sigma) {
  Matrix<N> root;
  for (int i = 0; i < N; ++i) root.col(i) = normal<N>(random, sigma / std::sqrt(double{N}));
  return root * root.transpose();
}

/// Anywhere within `reach`; in space the pitch stays away from straight up and down.
inline idl::Pose2D random_pose2(RandomStream& random, double sigma, double reach = 5.0) {
  idl::Pose2D pose = pose_of(
      Vector<3>(random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-3.14, 3.14)));
  set_covariance(pose, random_covariance<3>(random, sigma));
  return pose;
}
inline idl::Pose3D random_pose3(RandomStream& random, double sigma, double reach = 5.0) {
  Vector<6> v;
  for (int i = 0; i < 3; ++i) v(i) = random.uniform(-reach, reach);
  v(3) = random.uniform(-3.14, 3.14);
  v(4) = random.uniform(-1.2, 1.2);
  v(5) = random.uniform(-3.14, 3.14);
  idl::Pose3D pose = pose_of(v);
  set_covariance(pose, random_covariance<6>(random, sigma));
  return pose;
}

/// The rotation of a pose in space, worked out without the library under test.
inline Eigen::Matrix3d rotation_of(const idl::Pose3D& pose) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(pose.rotation().yaw(), Vector3d::UnitZ()) *
          AngleAxisd(pose.rotation().pitch(), Vector3d::UnitY()) *
          AngleAxisd(pose.rotation().roll(), Vector3d::UnitX()))
      .toRotationMatrix();
}

/// The derivatives of `function`, a vector of a vector, by central differences.
/// Step 1e-5: truncation is about 1e-10 of the third derivative, rounding about 1e-16 / 1e-5 = 1e-11 of the
/// value.
template <int N, int M, class F>
Eigen::Matrix<double, N, M> jacobian(F&& function, const Vector<M>& at) {
  constexpr double kStep = 1e-5;
  Eigen::Matrix<double, N, M> J;
  for (int i = 0; i < M; ++i) {
    Vector<M> low = at;
    Vector<M> high = at;
    low(i) -= kStep;
    high(i) += kStep;
    J.col(i) = difference<N>(function(low), function(high)) / (2.0 * kStep);
  }
  return J;
}

/// The smallest eigenvalue of the correlation matrix: below zero if `covariance` is none. Unlike that of the
/// covariance itself it does not depend on units. Rows of zeros are left out of account.
template <int N>
double least_correlation_eigenvalue(const Matrix<N>& covariance) {
  Vector<N> scale = covariance.diagonal();
  for (double& s : scale) s = s > 0.0 ? 1.0 / std::sqrt(s) : 1.0;
  const Matrix<N> correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Matrix<N>>(correlation, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

}  // namespace orca::test
