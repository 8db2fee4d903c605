// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "orca/base/random.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/hw/xr4000/base.hpp"

using namespace orca;
using namespace orca::hw::xr4000;

TEST_CASE("ahead is the XR4000's y axis, and left is against its x axis", "[hw][xr4000]") {
  CHECK(speeds_of({.forward = 0.3}) == Axes{0, 300, 0});
  CHECK(speeds_of({.left = 0.1}) == Axes{-100, 0, 0});
  CHECK(speeds_of({.turn_rate = 0.25}) == Axes{0, 0, 250});
  CHECK(velocity_of({-100, 300, -50}) == Twist2{0.3, 0.1, -0.05});
  const Pose2 pose = pose_of({-500, 1250, 785});
  CHECK(pose.x == Approx(1.25));
  CHECK(pose.y == Approx(0.5));
  CHECK(pose.yaw == Approx(0.785));
}

TEST_CASE("no axis of an XR4000 is told more than its limit", "[hw][xr4000]") {
  CHECK(speeds_of({10.0, -10.0, 10.0}) == Axes{1500, 1500, 500});
  CHECK(speeds_of({-10.0, 10.0, -10.0}) == Axes{-1500, -1500, -500});
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(speeds_of({std::nan(""), infinite, -infinite}) == Axes{});
  CHECK(accelerations_of(0.5, 2.0) == Axes{500, 500, 2000});
  CHECK(accelerations_of(99.0, 99.0) == Axes{1500, 1500, 5000});
  CHECK(accelerations_of(0.0, -1.0) == Axes{1, 1, 1});
}

TEST_CASE("a velocity of an XR4000 comes back from its axes, to half a millimetre per second",
          "[hw][xr4000]") {
  RandomStream random(1, "test", "velocity");
  for (int i = 0; i < 500; ++i) {
    const Twist2 told{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-0.5, 0.5)};
    const Twist2 got = velocity_of(speeds_of(told));
    CHECK(std::abs(got.forward - told.forward) < 0.00051);
    CHECK(std::abs(got.left - told.left) < 0.00051);
    CHECK(std::abs(got.turn_rate - told.turn_rate) < 0.00051);
  }
}

TEST_CASE("the heading of an XR4000's pose stays within half a turn, whatever the integrator counts",
          "[hw][xr4000]") {
  CHECK(pose_of({0, 0, 3200}).yaw == Approx(3.2 - 2.0 * std::numbers::pi));
  CHECK(std::abs(pose_of({0, 0, std::numeric_limits<std::int32_t>::min()}).yaw) <= std::numbers::pi);
}

TEST_CASE("the sonars of an XR4000 look outwards all around, and both rings have the same places",
          "[hw][xr4000]") {
  const double step = 2.0 * std::numbers::pi / 24.0;
  for (std::size_t door = 0; door < 3; ++door) {
    for (std::size_t i = 0; i < 8; ++i) {
      CAPTURE(door, i);
      const Pose2 low = sonar_place(16 * door + i);
      CHECK(sonar_place(16 * door + 8 + i) == low);
      CHECK(std::hypot(low.x, low.y) == Approx(kRadius).epsilon(1e-5));
      CHECK(low.yaw == Approx(std::atan2(low.y, low.x)));
      // The first sonar is that of the front door on the right, and they go on to the left.
      const double expected = step * (static_cast<double>(8 * door + i) - 3.5);
      CHECK(std::abs(wrapped(low.yaw - expected)) < 1e-4);
    }
  }
}

TEST_CASE("each door of an XR4000 is in the middle of its sonars", "[hw][xr4000]") {
  CHECK(door_of(0) == 0);
  CHECK(door_of(1) == 0);
  CHECK(door_of(5) == 2);
  for (std::size_t door = 0; door < 3; ++door) {
    const double middle = 0.5 * wrapped(sonar_place(16 * door + 4).yaw - sonar_place(16 * door + 3).yaw);
    CHECK(std::abs(wrapped(sonar_place(16 * door + 3).yaw + middle - door_direction(door))) < 1e-4);
  }
}

TEST_CASE("an XR4000's pose begins at 0, wherever its integrator is", "[hw][xr4000]") {
  IntegratorOdometry odometry;
  odometry.add({1000, -2000, 1571});
  CHECK(odometry.pose().x == Approx(0.0).margin(1e-12));
  CHECK(odometry.pose().y == Approx(0.0).margin(1e-12));
  CHECK(odometry.pose().yaw == Approx(0.0).margin(1e-12));
}

TEST_CASE("an XR4000's pose follows its integrator, in the frame in which it began", "[hw][xr4000]") {
  IntegratorOdometry odometry;
  odometry.add({0, 0, 0});
  odometry.add({-500, 1250, 785});
  CHECK(odometry.pose().x == Approx(1.25));
  CHECK(odometry.pose().y == Approx(0.5));
  CHECK(odometry.pose().yaw == Approx(0.785));
  IntegratorOdometry turned;  // It looks along the integrator's -x axis, which is to the left.
  turned.add({0, 0, 1571});
  turned.add({-1000, 0, 1571});
  CHECK(turned.pose().x == Approx(1.0).margin(1e-6));
  CHECK(turned.pose().y == Approx(0.0).margin(1e-3));
}

TEST_CASE("an XR4000's pose goes on from where it was when the integrator begins anew", "[hw][xr4000]") {
  IntegratorOdometry odometry;
  odometry.add({0, 0, 0});
  odometry.add({0, 700, 0});
  odometry.forget();
  odometry.add({5000, 5000, 3000});
  CHECK(odometry.pose().x == Approx(0.7));
  CHECK(odometry.pose().y == Approx(0.0).margin(1e-12));
  CHECK(odometry.pose().yaw == Approx(0.0).margin(1e-12));
}
