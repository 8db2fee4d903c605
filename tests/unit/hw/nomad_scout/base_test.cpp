// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "orca/hw/nomad_scout/base.hpp"

using namespace orca::hw::nomad_scout;
using orca::Twist2;

TEST_CASE("a turn to the left needs a faster right wheel", "[hw][scout]") {
  const Wheels wheels = wheels_of({.forward = 0.3, .turn_rate = 1.0}, 0.34);
  CHECK(wheels.right == Approx(0.47));
  CHECK(wheels.left == Approx(0.13));
}

TEST_CASE("the track follows from the manufacturer's factor between turn rate and wheel speed",
          "[hw][scout]") {
  // 0.118597 inches per degree and wheel: a turn of 1 degree per second.
  const double degree = std::numbers::pi / 180.0;
  CHECK(wheels_of({.turn_rate = degree}).right == Approx(0.118597 * 0.0254).epsilon(1e-4));
}

TEST_CASE("a twist comes back from its wheels", "[hw][scout]") {
  const Twist2 twist{.forward = -0.4, .turn_rate = 0.7};
  const Twist2 again = twist_of(wheels_of(twist));
  CHECK(again.forward == Approx(twist.forward));
  CHECK(again.turn_rate == Approx(twist.turn_rate));
  CHECK(again.left == 0.0);
}

TEST_CASE("sonars stand in a circle, the first one ahead, counting counter-clockwise", "[hw][scout]") {
  CHECK(sonar_pose(0, 0.2).x == Approx(0.2));
  CHECK(sonar_pose(0, 0.2).yaw == 0.0);
  CHECK(sonar_pose(1, 0.2).yaw == Approx(std::numbers::pi / 8));
  CHECK(sonar_pose(4, 0.21).y == Approx(0.21));
  CHECK(sonar_pose(8, 0.2).x == Approx(-0.2));
  CHECK(sonar_pose(15, 0.2).yaw == Approx(-std::numbers::pi / 8));
  for (std::size_t i = 0; i < kSonars; ++i)
    CHECK(std::hypot(sonar_pose(i, 0.2).x, sonar_pose(i, 0.2).y) == Approx(0.2));
}

TEST_CASE("signed numbers have a sign bit and a magnitude", "[hw][scout]") {
  CHECK(sign_and_magnitude(-50) == 0x8032);
  CHECK(from_sign_and_magnitude(0x8032) == -50);
  CHECK(from_sign_and_magnitude(0x7FFF) == 32767);
  CHECK(from_sign_and_magnitude(0xFFFF) == -32767);
}

TEST_CASE("a negative zero is zero", "[hw][scout]") {
  CHECK(from_sign_and_magnitude(0x8000) == 0);
  CHECK(sign_and_magnitude(0) == 0);
}

TEST_CASE("what does not fit is limited and keeps its sign", "[hw][scout]") {
  CHECK(sign_and_magnitude(40000) == 0x7FFF);
  CHECK(sign_and_magnitude(-40000) == 0xFFFF);
  CHECK(sign_and_magnitude(std::numeric_limits<int>::min()) == 0xFFFF);
}

TEST_CASE("all signed numbers of 16 bits come back", "[hw][scout]") {
  int wrong = 0;
  for (int value = -32767; value <= 32767; ++value)
    wrong += from_sign_and_magnitude(sign_and_magnitude(value)) != value;
  CHECK(wrong == 0);
}

TEST_CASE("lengths are in tenths of an inch, angles in tenths of a degree", "[hw][scout]") {
  CHECK(in_tenths_of_inch(0.254) == 100);
  CHECK(in_tenths_of_inch(-0.0013) == -1);
  CHECK(radians(-1800) == Approx(-std::numbers::pi));
}

TEST_CASE("what is no number counts as 0", "[hw][scout]") {
  CHECK(in_tenths_of_inch(std::nan("")) == 0);
  CHECK(in_tenths_of_inch(1e12) == 32767);
}
