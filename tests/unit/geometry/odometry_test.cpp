// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <limits>
#include <numbers>

#include "orca/geometry/objects/odometry.hpp"
#include "poses.hpp"

using namespace orca;
using namespace orca::test;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr DifferentialBase kScout{.track = 0.35, .left_noise = 1e-4, .right_noise = 2e-4};

WheelTravel rolled(double left, double right) { return {.left = left, .right = right, .stamp = {}}; }

// Returns the pose after rolling, as a vector of the pose before and the travel of both wheels.
Vector<3> driven(const Vector<5>& v) {
  return vector_of(integrate_arc(pose_of(Vector<3>(v.head<3>())), rolled(v(3), v(4)), kScout).value());
}

}  // namespace

TEST_CASE("equal wheels drive straight ahead", "[geometry][odometry]") {
  const auto pose = integrate_arc(pose_of(Vector<3>(1.0, 2.0, kPi / 2)), rolled(0.5, 0.5), kScout).value();
  CHECK(difference<3>(vector_of(pose), Vector<3>(1.0, 2.5, kPi / 2)).norm() < 1e-15);
}

TEST_CASE("opposite wheels turn on the spot", "[geometry][odometry]") {
  const double quarter = kScout.track * kPi / 4;
  const auto pose = integrate_arc(idl::Pose2D(), rolled(-quarter, quarter), kScout).value();
  CHECK(difference<3>(vector_of(pose), Vector<3>(0.0, 0.0, kPi / 2)).norm() < 1e-15);
}

TEST_CASE("a half circle ends beside its start, however large it is", "[geometry][odometry]") {
  const double radius = GENERATE(0.1, 1.0, 1000.0);
  const double half = kScout.track / 2;
  const auto pose =
      integrate_arc(idl::Pose2D(), rolled(kPi * (radius - half), kPi * (radius + half)), kScout).value();
  // The wheels' difference is rounded like the wheels' travel; the pose is off by that angle times the way.
  const double rounding = 1e-15 * kPi * (1.0 + radius / kScout.track) * 2.0 * radius;
  CHECK(pose.x() == Approx(0.0).margin(rounding));
  CHECK(pose.y() == Approx(2.0 * radius));
  CHECK(std::abs(pose.orientation()) == Approx(kPi));
}

TEST_CASE("the pose holds at the stamp of the travel", "[geometry][odometry]") {
  WheelTravel travel = rolled(0.1, 0.1);
  travel.stamp.ns(77);
  CHECK(integrate_arc(idl::Pose2D(), travel, kScout).value().stamp().ns() == 77);
}

TEST_CASE("an arc driven in two pieces ends where the whole does", "[geometry][odometry]") {
  RandomStream random(21, "test", "pieces");
  for (int i = 0; i < 1000; ++i) {
    const double left = random.uniform(-1.0, 1.0);
    const double right = random.uniform(-1.0, 1.0);
    const double part = random.uniform(0.0, 1.0);
    const idl::Pose2D start = random_pose2(random, 0.0);
    const idl::Pose2D whole = integrate_arc(start, rolled(left, right), kScout).value();
    const idl::Pose2D first = integrate_arc(start, rolled(part * left, part * right), kScout).value();
    const idl::Pose2D both =
        integrate_arc(first, rolled((1.0 - part) * left, (1.0 - part) * right), kScout).value();
    REQUIRE(difference<3>(vector_of(whole), vector_of(both)).norm() < 1e-13);
  }
}

TEST_CASE("the covariance of odometry agrees with numerical derivatives", "[geometry][odometry]") {
  RandomStream random(22, "test", "jacobian");
  for (int i = 0; i < 500; ++i) {
    const idl::Pose2D start = random_pose2(random, 0.1);
    // Includes travel that is nearly straight, where the series are used.
    const double left = random.uniform(-0.5, 0.5);
    const double right = random.chance(0.5) ? left + random.normal(0.0, 0.02) : random.uniform(-0.5, 0.5);
    Vector<5> at;
    at << vector_of(start), left, right;
    const auto J = jacobian<3, 5>(driven, at);
    Matrix<5> C = Matrix<5>::Zero();
    C.topLeftCorner<3, 3>() = covariance_of(start);
    C(3, 3) = kScout.left_noise * std::abs(left);
    C(4, 4) = kScout.right_noise * std::abs(right);
    const auto end = integrate_arc(start, rolled(left, right), kScout).value();
    REQUIRE((covariance_of(end) - J * C * J.transpose()).norm() < 1e-10);
  }
}

TEST_CASE("the derivatives are continuous where the series take over", "[geometry][odometry]") {
  // The series are used for turns below 0.1 rad.
  const auto covariance_for_turn = [](double turn) {
    const double side = turn * kScout.track / 2;
    return covariance_of(integrate_arc(idl::Pose2D(), rolled(1.0 - side, 1.0 + side), kScout).value());
  };
  const double below = std::nextafter(0.1, 0.0) * (1.0 - 1e-12);
  const double above = 0.1 * (1.0 + 1e-12);
  CHECK((covariance_for_turn(below) - covariance_for_turn(above)).norm() < 1e-14);
}

TEST_CASE(
    "with noise the heading's uncertainty grows along the way, and without noise nothing becomes uncertain",
    "[geometry][odometry]") {
  idl::Pose2D pose;
  double last = 0.0;
  for (int i = 0; i < 100; ++i) {
    pose = integrate_arc(pose, rolled(0.1, 0.11), kScout).value();
    CHECK(pose.covariance()[8] > last);
    last = pose.covariance()[8];
  }
  const auto exact = integrate_arc(idl::Pose2D(), rolled(1.0, 1.2), {.track = 0.35}).value();
  CHECK(covariance_of(exact).norm() == 0.0);
}

TEST_CASE("the variance of the heading is the variance of the difference of the wheels",
          "[geometry][odometry]") {
  const auto pose = integrate_arc(idl::Pose2D(), rolled(2.0, -1.0), kScout).value();
  CHECK(pose.covariance()[8] == Approx((2.0 * 1e-4 + 1.0 * 2e-4) / (0.35 * 0.35)));
}

TEST_CASE("the covariance of odometry stays a valid one through a hundred thousand random steps",
          "[geometry][odometry]") {
  RandomStream random(23, "test", "steps");
  idl::Pose2D pose;
  double least = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    pose =
        integrate_arc(pose, rolled(random.uniform(-0.02, 0.05), random.uniform(-0.02, 0.05)), kScout).value();
    const Matrix<3> C = covariance_of(pose);
    REQUIRE(C == C.transpose());
    least = std::min(least, least_correlation_eigenvalue<3>(C));
  }
  INFO("least eigenvalue of the correlation " << least);
  CHECK(least > -1e-14);
}

TEST_CASE("an impossible base or travel is refused", "[geometry][odometry]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double track : {0.0, -0.1, nan, infinity}) {
    const auto result = integrate_arc(idl::Pose2D(), rolled(1, 1), {.track = track});
    REQUIRE_FALSE(result);
    CHECK_THAT(result.error().message, Catch::StartsWith("the track is "));
  }
  for (const double noise : {-1e-9, nan, infinity}) {
    CHECK_FALSE(integrate_arc(idl::Pose2D(), rolled(1, 1), {.track = 1, .left_noise = noise}));
    CHECK_FALSE(integrate_arc(idl::Pose2D(), rolled(1, 1), {.track = 1, .right_noise = noise}));
  }
  CHECK_FALSE(integrate_arc(idl::Pose2D(), rolled(nan, 1), kScout));
  CHECK_FALSE(integrate_arc(idl::Pose2D(), rolled(1, infinity), kScout));
}
