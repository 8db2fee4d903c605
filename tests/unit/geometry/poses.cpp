// SPDX-License-Identifier: GPL-3.0-or-later
#include "poses.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace orca::test {
namespace {

template <int N>
using Rows = Eigen::Matrix<double, N, N, Eigen::RowMajor>;

}  // namespace

Vector<3> vector_of(const idl::Pose2D& pose) { return {pose.x(), pose.y(), pose.orientation()}; }

Vector<6> vector_of(const idl::Pose3D& pose) {
  Vector<6> v;
  v << pose.position().x(), pose.position().y(), pose.position().z(), pose.rotation().roll(),
      pose.rotation().pitch(), pose.rotation().yaw();
  return v;
}

idl::Pose2D pose_of(const Vector<3>& v) {
  idl::Pose2D pose;
  pose.x(v(0));
  pose.y(v(1));
  pose.orientation(v(2));
  return pose;
}

idl::Pose3D pose_of(const Vector<6>& v) {
  idl::Pose3D pose;
  pose.position(make_point(v(0), v(1), v(2)));
  pose.rotation().roll(v(3));
  pose.rotation().pitch(v(4));
  pose.rotation().yaw(v(5));
  return pose;
}

Matrix<3> covariance_of(const idl::Pose2D& pose) {
  return Eigen::Map<const Rows<3>>(pose.covariance().data());
}

Matrix<6> covariance_of(const idl::Pose3D& pose) {
  return Eigen::Map<const Rows<6>>(pose.covariance().data());
}

void set_covariance(idl::Pose2D& pose, const Matrix<3>& covariance) {
  Eigen::Map<Rows<3>>(pose.covariance().data()) = covariance;
}

void set_covariance(idl::Pose3D& pose, const Matrix<6>& covariance) {
  Eigen::Map<Rows<6>>(pose.covariance().data()) = covariance;
}

template <int N>
Vector<N> normal(RandomStream& random, double sigma) {
  Vector<N> v;
  for (int i = 0; i < N; ++i) v(i) = random.normal(0.0, sigma);
  return v;
}

template <int N>
Matrix<N> random_covariance(RandomStream& random, double sigma) {
  Matrix<N> root;
  for (int i = 0; i < N; ++i) root.col(i) = normal<N>(random, sigma / std::sqrt(double{N}));
  return root * root.transpose();
}

template <int N>
double least_correlation_eigenvalue(const Matrix<N>& covariance) {
  Vector<N> scale = covariance.diagonal();
  for (double& s : scale) s = s > 0.0 ? 1.0 / std::sqrt(s) : 1.0;
  const Matrix<N> correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Matrix<N>>(correlation, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

template Vector<3> normal<3>(RandomStream& random, double sigma);
template Vector<6> normal<6>(RandomStream& random, double sigma);
template Matrix<3> random_covariance<3>(RandomStream& random, double sigma);
template Matrix<6> random_covariance<6>(RandomStream& random, double sigma);
template double least_correlation_eigenvalue<3>(const Matrix<3>& covariance);
template double least_correlation_eigenvalue<6>(const Matrix<6>& covariance);

idl::Pose2D random_pose2(RandomStream& random, double sigma, double reach) {
  idl::Pose2D pose = pose_of(
      Vector<3>(random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-3.14, 3.14)));
  set_covariance(pose, random_covariance<3>(random, sigma));
  return pose;
}

idl::Pose3D random_pose3(RandomStream& random, double sigma, double reach) {
  Vector<6> v;
  for (int i = 0; i < 3; ++i) v(i) = random.uniform(-reach, reach);
  v(3) = random.uniform(-3.14, 3.14);
  v(4) = random.uniform(-1.2, 1.2);
  v(5) = random.uniform(-3.14, 3.14);
  idl::Pose3D pose = pose_of(v);
  set_covariance(pose, random_covariance<6>(random, sigma));
  return pose;
}

Eigen::Matrix3d rotation_of(const idl::Pose3D& pose) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(pose.rotation().yaw(), Vector3d::UnitZ()) *
          AngleAxisd(pose.rotation().pitch(), Vector3d::UnitY()) *
          AngleAxisd(pose.rotation().roll(), Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace orca::test
