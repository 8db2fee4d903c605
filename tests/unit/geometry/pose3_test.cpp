// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "poses.hpp"
#include "rounding.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// Compared as rotations, because roll, pitch and yaw are not unique.
bool same_place(const idl::Pose3D& a, const idl::Pose3D& b) {
  return (vector_of(a).head<3>() - vector_of(b).head<3>()).norm() < kRounding &&
         (rotation_of(a) - rotation_of(b)).norm() < kRounding;
}

// Rounding of 1e-16 is divided by cos(pitch) up to four times; is_steep() keeps that above 0.05^4 = 6e-6.
bool same_covariance(const idl::Pose3D& a, const idl::Pose3D& b) {
  const double size = covariance_of(a).norm();
  return (covariance_of(a) - covariance_of(b)).norm() < 1e-9 * size;
}

bool is_steep(const idl::Pose3D& pose) { return std::cos(pose.rotation().pitch()) < 0.05; }

idl::Pose3D without_covariance(const idl::Pose3D& pose) { return pose_of(vector_of(pose)); }

}  // namespace

TEST_CASE("composing in space turns and shifts as matrices do", "[geometry][pose3]") {
  RandomStream random(11, "test", "compose");
  for (int i = 0; i < 1000; ++i) {
    const idl::Pose3D a = without_covariance(random_pose3(random, 0.1));
    const idl::Pose3D b = without_covariance(random_pose3(random, 0.1));
    const idl::Pose3D ab = compose(a, b).value();
    REQUIRE((rotation_of(ab) - rotation_of(a) * rotation_of(b)).norm() < kRounding);
    const Eigen::Vector3d place = vector_of(a).head<3>() + rotation_of(a) * vector_of(b).head<3>();
    REQUIRE((vector_of(ab).head<3>() - place).norm() < kRounding);
  }
}

TEST_CASE("level poses in space compose as those in the plane do", "[geometry][pose3]") {
  RandomStream random(12, "test", "level");
  const idl::Pose2D a = random_pose2(random, 0.1);
  const idl::Pose2D b = random_pose2(random, 0.1);
  const auto lifted = [](const idl::Pose2D& pose) {
    Eigen::Matrix<double, 6, 3> lift = Eigen::Matrix<double, 6, 3>::Zero();
    lift(0, 0) = lift(1, 1) = lift(5, 2) = 1.0;
    idl::Pose3D up = pose_of(Vector<6>(lift * vector_of(pose)));
    set_covariance(up, Matrix<6>(lift * covariance_of(pose) * lift.transpose()));
    return up;
  };
  CHECK(same_place(compose(lifted(a), lifted(b)).value(), lifted(compose(a, b))));
  CHECK(same_covariance(compose(lifted(a), lifted(b)).value(), lifted(compose(a, b))));
  CHECK(same_place(inverse(lifted(a)).value(), lifted(inverse(a))));
  CHECK(same_covariance(inverse(lifted(a)).value(), lifted(inverse(a))));
}

TEST_CASE("a pose in space composed with its inverse is the identity, on both sides", "[geometry][pose3]") {
  RandomStream random(13, "test", "inverse");
  for (int i = 0; i < 1000; ++i) {
    const idl::Pose3D X = without_covariance(random_pose3(random, 0.1));
    REQUIRE(same_place(compose(X, inverse(X).value()).value(), idl::Pose3D()));
    REQUIRE(same_place(compose(inverse(X).value(), X).value(), idl::Pose3D()));
  }
}

TEST_CASE("the inverse of the inverse in space is the pose again, with its covariance", "[geometry][pose3]") {
  RandomStream random(14, "test", "inverse");
  int tried = 0;
  for (int i = 0; i < 1000; ++i) {
    const idl::Pose3D X = random_pose3(random, 0.1);
    const idl::Pose3D back = inverse(X).value();
    if (is_steep(back)) continue;
    ++tried;
    REQUIRE(same_place(inverse(back).value(), X));
    REQUIRE(same_covariance(inverse(back).value(), X));
  }
  CHECK(tried > 900);
}

TEST_CASE("composing in space is associative, covariances included", "[geometry][pose3]") {
  RandomStream random(15, "test", "associative");
  int tried = 0;
  for (int i = 0; i < 1000; ++i) {
    const idl::Pose3D a = random_pose3(random, 0.05);
    const idl::Pose3D b = random_pose3(random, 0.05);
    const idl::Pose3D c = random_pose3(random, 0.05);
    const idl::Pose3D ab = compose(a, b).value();
    const idl::Pose3D bc = compose(b, c).value();
    const idl::Pose3D abc = compose(ab, c).value();
    if (is_steep(ab) || is_steep(bc) || is_steep(abc)) continue;
    ++tried;
    REQUIRE(same_place(abc, compose(a, bc).value()));
    REQUIRE(same_covariance(abc, compose(a, bc).value()));
  }
  CHECK(tried > 700);
}

TEST_CASE("covariances in space agree with numerical derivatives", "[geometry][pose3]") {
  RandomStream random(16, "test", "jacobian");
  const auto composed = [](const Eigen::Matrix<double, 12, 1>& both) {
    return vector_of(compose(pose_of(Vector<6>(both.head<6>())), pose_of(Vector<6>(both.tail<6>()))).value());
  };
  const auto inverted = [](const Vector<6>& v) { return vector_of(inverse(pose_of(v)).value()); };
  int tried = 0;
  for (int i = 0; i < 200; ++i) {
    const idl::Pose3D a = random_pose3(random, 0.1);
    const idl::Pose3D b = random_pose3(random, 0.1);
    const idl::Pose3D ab = compose(a, b).value();
    const idl::Pose3D back = inverse(a).value();
    if (is_steep(ab) || is_steep(back)) continue;
    ++tried;
    Eigen::Matrix<double, 12, 1> both;
    both << vector_of(a), vector_of(b);
    const auto J = jacobian<6, 12>(composed, both);
    Matrix<12> C = Matrix<12>::Zero();
    C.topLeftCorner<6, 6>() = covariance_of(a);
    C.bottomRightCorner<6, 6>() = covariance_of(b);
    // Third derivatives grow with 1 / cos(pitch)^3, up to 8000 here, times the step of 1e-5 squared.
    REQUIRE((covariance_of(ab) - J * C * J.transpose()).norm() < 1e-5 * covariance_of(ab).norm());
    const auto K = jacobian<6, 6>(inverted, vector_of(a));
    REQUIRE((covariance_of(back) - K * covariance_of(a) * K.transpose()).norm() <
            1e-5 * covariance_of(back).norm());
  }
  CHECK(tried > 150);
}

TEST_CASE("a pose that points straight up is valid, but has no covariance of roll and yaw",
          "[geometry][pose3]") {
  idl::Pose3D level;
  idl::Pose3D up;
  up.rotation().pitch(-kPi / 2);
  up.rotation().yaw(0.7);
  up.rotation().roll(0.4);
  CHECK(same_place(compose(level, up).value(), up));
  level.covariance()[0] = 0.01;
  const auto refused = compose(level, up);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Code::failed_precondition);
  CHECK_THAT(refused.error().message, Catch::Contains("straight up or down"));
}

TEST_CASE("a result in space has the latest stamp of its inputs", "[geometry][pose3]") {
  idl::Pose3D a;
  idl::Pose3D b;
  a.stamp().ns(5);
  b.stamp().ns(3);
  CHECK(compose(a, b).value().stamp().ns() == 5);
  CHECK(compose(b, a).value().stamp().ns() == 5);
  CHECK(inverse(b).value().stamp().ns() == 3);
}

TEST_CASE("the covariance in space stays a valid one through a hundred thousand random steps",
          "[geometry][pose3]") {
  RandomStream random(17, "test", "steps");
  idl::Pose3D pose;
  double least = 0.0;
  int steps = 0;
  while (steps < 100'000) {
    Vector<6> step = normal<6>(random, 0.02);
    idl::Pose3D next = pose_of(step);
    set_covariance(next, random_covariance<6>(random, 1e-3));
    Result<idl::Pose3D> result = compose(pose, next);
    if (result && random.chance(0.1)) result = inverse(*result);
    // A new start where first order ends: near straight up.
    pose = result && !is_steep(*result) ? *result : idl::Pose3D();
    if (!result || is_steep(*result)) continue;
    ++steps;
    const Matrix<6> C = covariance_of(pose);
    REQUIRE(C == C.transpose());
    least = std::min(least, least_correlation_eigenvalue<6>(C));
  }
  INFO("least eigenvalue of the correlation " << least);
  CHECK(least > -1e-14);
}
