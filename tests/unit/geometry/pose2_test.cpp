// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "poses.hpp"
#include "rounding.hpp"

using namespace orca;
using namespace orca::test;

namespace {

bool near(const idl::Pose2D& a, const idl::Pose2D& b) {
  return difference<3>(vector_of(a), vector_of(b)).norm() < kRounding &&
         (covariance_of(a) - covariance_of(b)).norm() < kRounding * (1.0 + covariance_of(a).norm());
}

Vector<3> composed(const Eigen::Matrix<double, 6, 1>& both) {
  return vector_of(compose(pose_of(Vector<3>(both.head<3>())), pose_of(Vector<3>(both.tail<3>()))));
}

}  // namespace

TEST_CASE("composing walks along the second pose from the first", "[geometry][pose2]") {
  const idl::Pose2D X_AC = compose(pose_of(Vector<3>(1.0, 2.0, kPi / 2)), pose_of(Vector<3>(3.0, 1.0, kPi)));
  CHECK(near(X_AC, pose_of(Vector<3>(0.0, 5.0, -kPi / 2))));
}

TEST_CASE("a result has the latest stamp of its inputs", "[geometry][pose2]") {
  idl::Pose2D a;
  idl::Pose2D b;
  a.stamp().ns(5);
  b.stamp().ns(3);
  CHECK(compose(a, b).stamp().ns() == 5);
  CHECK(compose(b, a).stamp().ns() == 5);
  CHECK(inverse(b).stamp().ns() == 3);
}

TEST_CASE("a pose composed with its inverse is the identity, on both sides", "[geometry][pose2]") {
  RandomStream random(1, "test", "inverse");
  for (int i = 0; i < 1000; ++i) {
    const idl::Pose2D X = pose_of(vector_of(random_pose2(random, 0.1)));
    REQUIRE(near(compose(X, inverse(X)), idl::Pose2D()));
    REQUIRE(near(compose(inverse(X), X), idl::Pose2D()));
  }
}

TEST_CASE("the inverse of the inverse is the pose again, with its covariance", "[geometry][pose2]") {
  RandomStream random(2, "test", "inverse");
  for (int i = 0; i < 1000; ++i) {
    const idl::Pose2D X = random_pose2(random, 0.3);
    REQUIRE(near(inverse(inverse(X)), X));
  }
}

TEST_CASE("composing with an exact identity changes neither pose nor covariance", "[geometry][pose2]") {
  RandomStream random(3, "test", "identity");
  const idl::Pose2D X = random_pose2(random, 0.3);
  CHECK(near(compose(X, idl::Pose2D()), X));
  CHECK(near(compose(idl::Pose2D(), X), X));
}

TEST_CASE("composing is associative, covariances included", "[geometry][pose2]") {
  RandomStream random(4, "test", "associative");
  for (int i = 0; i < 1000; ++i) {
    const idl::Pose2D a = random_pose2(random, 0.1);
    const idl::Pose2D b = random_pose2(random, 0.1);
    const idl::Pose2D c = random_pose2(random, 0.1);
    REQUIRE(near(compose(compose(a, b), c), compose(a, compose(b, c))));
  }
}

TEST_CASE("the inverse of a composition is the inverses composed the other way round", "[geometry][pose2]") {
  RandomStream random(5, "test", "inverse");
  for (int i = 0; i < 1000; ++i) {
    const idl::Pose2D a = random_pose2(random, 0.1);
    const idl::Pose2D b = random_pose2(random, 0.1);
    REQUIRE(near(inverse(compose(a, b)), compose(inverse(b), inverse(a))));
  }
}

TEST_CASE("covariances in the plane agree with numerical derivatives", "[geometry][pose2]") {
  RandomStream random(6, "test", "jacobian");
  for (int i = 0; i < 200; ++i) {
    const idl::Pose2D a = random_pose2(random, 0.3);
    const idl::Pose2D b = random_pose2(random, 0.3);
    Eigen::Matrix<double, 6, 1> both;
    both << vector_of(a), vector_of(b);
    const auto J = jacobian<3, 6>(composed, both);
    Matrix<6> C = Matrix<6>::Zero();
    C.topLeftCorner<3, 3>() = covariance_of(a);
    C.bottomRightCorner<3, 3>() = covariance_of(b);
    REQUIRE((covariance_of(compose(a, b)) - J * C * J.transpose()).norm() < 1e-8);

    const auto K =
        jacobian<3, 3>([](const Vector<3>& v) { return vector_of(inverse(pose_of(v))); }, vector_of(a));
    REQUIRE((covariance_of(inverse(a)) - K * covariance_of(a) * K.transpose()).norm() < 1e-8);
  }
}

TEST_CASE("the covariance in the plane stays a valid one through a hundred thousand random steps",
          "[geometry][pose2]") {
  RandomStream random(7, "test", "steps");
  idl::Pose2D pose;
  double least = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    pose = compose(pose, random_pose2(random, 1e-3, 0.1));
    if (random.chance(0.1)) pose = inverse(pose);
    const Matrix<3> C = covariance_of(pose);
    REQUIRE(C == C.transpose());
    least = std::min(least, least_correlation_eigenvalue<3>(C));
  }
  INFO("least eigenvalue of the correlation " << least);
  CHECK(least > -1e-14);
}

TEST_CASE("a position is as uncertain as it is in its worst direction", "[geometry][pose2]") {
  CHECK(position_deviation({}) == 0.0);
  CHECK(position_deviation({0.09, 0, 0, 0, 0.01, 0, 0, 0, 4.0}) == Approx(0.3));
  // The same ellipse, turned by 30 deg; the orientation does not count.
  const double c = std::cos(kPi / 6);
  const double s = std::sin(kPi / 6);
  const double cross = (0.09 - 0.01) * s * c;
  CHECK(position_deviation({0.09 * c * c + 0.01 * s * s, cross, 0.5, cross, 0.09 * s * s + 0.01 * c * c, 0.5,
                            0.5, 0.5, 4.0}) == Approx(0.3));
}
