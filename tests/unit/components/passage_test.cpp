// SPDX-License-Identifier: GPL-3.0-or-later
#include "traverse_door/passage.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using orca::Pose2;
using orca::Vec2;
using namespace orca::doors;

namespace {

constexpr double kRunUpOfDoor = 0.7;  // [m]

// A wall of points, 2 cm apart, at x = -0.05 m with a gap.
std::vector<Vec2> wall_with_gap(double from, double to) {
  std::vector<Vec2> points;
  for (double y = -1.0; y < 1.0; y += 0.02)
    if (y <= from || y >= to) points.push_back({-0.05, y});
  return points;
}

// Drives a robot that obeys each step, until it is behind the door or the time is over.
// @return how far it was off the axis while its body was in the doorway, at most [m]; 1 if it did not get through.
double worst_offset(Pose2 robot, double middle) {
  constexpr double kTick = 0.05;  // [s]
  double worst = 0.0;
  bool lined_up = false;
  for (int i = 0; i < 2000; ++i) {
    const auto step = lined_up ? std::nullopt : line_up(robot, middle, kRunUpOfDoor, 0.2);
    lined_up = lined_up || !step;
    const Step done = step ? *step : pass(robot, middle, 0.2);
    robot = robot * Pose2{done.speed * kTick, 0.0, done.turn_rate * kTick};
    if (robot.x > -0.3) worst = std::max(worst, std::fabs(robot.y - middle));
    if (robot.x > 0.4) return worst;
  }
  return 1.0;
}

}  // namespace

TEST_CASE("the gap in a doorway lies between what the scan shows on both sides", "[doors]") {
  const auto gap = gap_in(wall_with_gap(-0.2, 0.32), 0.52);
  REQUIRE(gap);
  CHECK(gap->middle == Approx(0.06).margin(0.02));
  CHECK(gap->width == Approx(0.52).margin(0.04));
  CHECK_FALSE(gap_in({}, 0.52));
  const auto none = gap_in(wall_with_gap(0.0, 0.0), 0.52);
  REQUIRE(none);
  CHECK(none->width < 0.05);
}

TEST_CASE("a robot lines up and passes within 2 cm of the middle, from wherever it comes", "[doors]") {
  for (const double middle : {0.0, 0.05})
    for (const double yaw : {-2.0, -0.5, 0.0, 0.5, 2.0})
      for (const Vec2 place : {Vec2{-1.0, 0.0}, Vec2{-0.7, 0.1}, Vec2{-0.9, 0.6}, Vec2{-0.6, -0.8}}) {
        CAPTURE(middle, yaw, place.x, place.y);
        CHECK(worst_offset({place.x, place.y, yaw}, middle) < 0.02);
      }
}
