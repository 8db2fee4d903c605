// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "orca/base/random.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/objects/covariance.hpp"

// Templates that are slow to compile are instantiated once, in poses.cpp.
namespace orca::test {

/// A pose as a vector of its N numbers, for tests that treat the plane (3) and space (6) alike.
template <int N>
using Vector = Eigen::Matrix<double, N, 1>;
template <int N>
using Matrix = Eigen::Matrix<double, N, N>;

Vector<3> vector_of(const idl::Pose2D& pose);
Vector<6> vector_of(const idl::Pose3D& pose);
idl::Pose2D pose_of(const Vector<3>& v);
idl::Pose3D pose_of(const Vector<6>& v);

/// Returns b - a; angles the short way round. Angles are the last 1 of 3 and the last 3 of 6.
template <int N>
Vector<N> difference(const Vector<N>& a, const Vector<N>& b) {
  Vector<N> d = b - a;
  for (int i = N / 2 + (N == 3 ? 1 : 0); i < N; ++i) d(i) = wrapped(d(i));
  return d;
}

Matrix<3> covariance_of(const idl::Pose2D& pose);
Matrix<6> covariance_of(const idl::Pose3D& pose);
void set_covariance(idl::Pose2D& pose, const Matrix<3>& covariance);
void set_covariance(idl::Pose3D& pose, const Matrix<6>& covariance);

/// A random vector with independent normal entries; N is 3 or 6.
template <int N>
Vector<N> normal(RandomStream& random, double sigma);

/// Returns a random covariance, none of whose standard deviations is much over `sigma`; N is 3 or 6.
template <int N>
Matrix<N> random_covariance(RandomStream& random, double sigma);

/// Returns a pose anywhere within `reach`; in space the pitch stays away from straight up and down.
idl::Pose2D random_pose2(RandomStream& random, double sigma, double reach = 5.0);
idl::Pose3D random_pose3(RandomStream& random, double sigma, double reach = 5.0);

/// Returns the rotation of a pose in space, computed without the library under test.
Eigen::Matrix3d rotation_of(const idl::Pose3D& pose);

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

/// Returns the smallest eigenvalue of the correlation matrix: below zero if `covariance` is none; N is 3 or
/// 6. Unlike the eigenvalue of the covariance itself, it does not depend on units. Rows of zeros are ignored.
template <int N>
double least_correlation_eigenvalue(const Matrix<N>& covariance);

}  // namespace orca::test
