// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/base_odometry.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <numbers>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/plane.hpp"

using namespace orca;
using namespace orca::hw;
using namespace std::chrono_literals;

namespace {

constexpr double kPi = std::numbers::pi;

Pose2 published(BaseOdometry& odometry) {
  return plane_pose(*object_cast<idl::Odometry>(odometry.endpoint().latest()));
}

// Returns where a base ends whose controller counts an arc in small steps.
Pose2 end_of(const Calibration& calibration, const Travel2& counted) {
  constexpr int kSteps = 1000;
  BaseOdometry odometry(std::chrono::milliseconds(100), {.calibration = calibration});
  Pose2 pose;
  odometry.publish(pose, {}, TimePoint{});
  for (int i = 0; i < kSteps; ++i) {
    pose = along_arc(pose, {counted.forward / kSteps, 0.0, counted.turn / kSteps});
    odometry.publish(pose, {}, TimePoint{});
  }
  return published(odometry);
}

void check_near(const Pose2& got, const Pose2& wanted) {
  CHECK(got.x == Approx(wanted.x).margin(1e-9));
  CHECK(got.y == Approx(wanted.y).margin(1e-9));
  CHECK(got.yaw == Approx(wanted.yaw).margin(1e-9));
}

}  // namespace

TEST_CASE("without calibration odometry is passed on as it is counted", "[hw][odometry]") {
  BaseOdometry odometry(std::chrono::milliseconds(100));
  const Pose2 counted{0.1, 0.2, 0.3};
  odometry.publish(counted, {0.4, 0.5, 0.6}, TimePoint(7s));
  CHECK(published(odometry) == counted);
  const auto object = object_cast<idl::Odometry>(odometry.endpoint().latest());
  CHECK(object->translational_velocity() == 0.4);
  CHECK(object->sideways_velocity() == 0.5);
  CHECK(object->steering_velocity() == 0.6);
  CHECK(to_time_point(object->stamp()) == TimePoint(7s));
}

TEST_CASE("a calibrated base has driven and turned by the factors more than is counted", "[hw][odometry]") {
  check_near(end_of({.distance = 1.05}, {2.0, 0.0, 0.0}), {2.1, 0.0, 0.0});
  check_near(end_of({.turn = 1.1}, {0.0, 0.0, 2.0}), {0.0, 0.0, 2.2});
  // A quarter of a circle of 1 m, counted.
  check_near(end_of({.distance = 2.0}, {0.5 * kPi, 0.0, 0.5 * kPi}), {2.0, 2.0, 0.5 * kPi});
  check_near(end_of({.turn = 0.5}, {0.5 * kPi, 0.0, 0.5 * kPi}),
             {std::sqrt(2.0), 2.0 - std::sqrt(2.0), 0.25 * kPi});
}

TEST_CASE("a base with unlike wheels turns as it drives, though its controller counts no turn",
          "[hw][odometry]") {
  check_near(end_of({.turn_per_metre = 0.25}, {2.0, 0.0, 0.0}), along_arc({}, {2.0, 0.0, 0.5}));
  check_near(end_of({.turn_per_metre = 0.25}, {-2.0, 0.0, 0.0}), along_arc({}, {-2.0, 0.0, -0.5}));
  check_near(end_of({.turn_per_metre = 0.25}, {0.0, 0.0, 2.0}), {0.0, 0.0, 2.0});
  const Calibration calibration{.distance = 1.25, .turn = 0.8, .turn_per_metre = 0.25};
  const Twist2 told = calibration.to_controller({0.5, 0.0, 0.1});
  CHECK(told.turn_rate == Approx(0.0));
  CHECK(calibration.to_base(told).turn_rate == Approx(0.1));
}

TEST_CASE("what a calibrated base is told, and what it tells of its velocity, agree", "[hw][odometry]") {
  const Calibration calibration{.distance = 1.25, .turn = 0.8};
  const Twist2 told = calibration.to_controller({0.5, 0.25, 0.8});
  CHECK(told.forward == Approx(0.4));
  CHECK(told.left == Approx(0.2));
  CHECK(told.turn_rate == Approx(1.0));
  const Twist2 real = calibration.to_base(told);
  CHECK(real.forward == Approx(0.5));
  CHECK(real.left == Approx(0.25));
  CHECK(real.turn_rate == Approx(0.8));
}

TEST_CASE("odometry whose errors are guessed tells how uncertain it is, and otherwise that it is not known",
          "[hw][odometry]") {
  const auto covariance_after = [](const SenseTraits& traits) {
    BaseOdometry odometry(std::chrono::milliseconds(100), traits);
    odometry.publish({}, {}, TimePoint{});
    for (int i = 1; i <= 100; ++i) odometry.publish({0.02 * i, 0.0, 0.0}, {}, TimePoint{});
    return object_cast<idl::Odometry>(odometry.endpoint().latest())->covariance();
  };
  CHECK(covariance_after({}) == std::array<double, 9>{});
  const WheelErrorGuess slip{.slip = 0.01};
  const auto guessed = covariance_after({.odometry = OdometryUncertainty(idl::DIFFERENTIAL, 0.4, slip)});
  CHECK(guessed[0] == Approx(0.5 * 1e-4 * 2.0).epsilon(1e-6));  // two wheels over 2 m
  CHECK(guessed[4] > guessed[0]);                               // a wrong heading counts more aside
}

TEST_CASE("the first counts of a base are only a reference, and so are those of a new connection", "[hw]") {
  CountedPose counted(32768);
  counted.take(1190, 32649, 0.00084, 0.5);
  CHECK(counted.pose() == Pose2{});
  counted.take(1190 + 500, 32649, 0.00084, 1.0);
  CHECK(counted.pose().x == Approx(0.42 * std::cos(0.5)));
  CHECK(counted.pose().y ==
        Approx(-0.42 * std::sin(0.5)));  // the controller's x axis is 0.5 rad to the right
  CHECK(counted.pose().yaw == Approx(0.5));
  const Pose2 before = counted.pose();
  counted.forget();
  counted.take(5000, 0, 0.00084, -2.0);
  CHECK(counted.pose().x == before.x);
  CHECK(counted.pose().y == before.y);
  CHECK(counted.pose().yaw == Approx(before.yaw));
}

TEST_CASE("a step over the end of the counts is a small one", "[hw]") {
  const auto [turn, from, to, step] = GENERATE(table<int, int, int, int>({{32768, 32700, 68, 136},
                                                                          {32768, 68, 32700, -136},
                                                                          {32768, 32767, 0, 1},
                                                                          {32768, 0, 16383, 16383},
                                                                          {32768, 0, 16384, -16384},
                                                                          {65536, 32760, -32766, 10},
                                                                          {65536, -32766, 32760, -10},
                                                                          {65536, 32767, 32767, 0},
                                                                          {65536, -16000, 16000, 32000}}));
  INFO(turn << " " << from << " " << to);
  CountedPose counted(turn);
  counted.take(from, 0, 1.0, 0.0);
  counted.take(to, 0, 1.0, 0.0);
  CHECK(counted.pose().x == step);
}

TEST_CASE("a long way in small steps is the sum of its steps, however often the counts wrap", "[hw]") {
  RandomStream random(1, "test", "counted pose");
  CountedPose counted(32768);
  long x = 7;
  long y = -3;
  counted.take(7, -3 & 0x7FFF, 1.0, 0.0);
  for (int i = 0; i < 10'000; ++i) {
    x += std::lround(random.uniform(-2000, 16000));
    y += std::lround(random.uniform(-16000, 2000));
    counted.take(static_cast<int>(x & 0x7FFF), static_cast<int>(y & 0x7FFF), 1.0, 0.0);
  }
  CHECK(counted.pose() == Pose2{static_cast<double>(x - 7), static_cast<double>(y + 3), 0.0});
  CHECK(x > 50'000'000);
}
