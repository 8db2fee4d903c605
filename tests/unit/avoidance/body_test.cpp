// SPDX-License-Identifier: GPL-3.0-or-later
// A body that is longer than wide: where it passes, and how far it can turn.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include "orca/avoidance/advice.hpp"
#include "orca/base/random.hpp"
#include "slow_run.hpp"

using namespace orca::avoid;
using orca::Vec2;
using std::numbers::pi;

namespace {

constexpr double kHalfLength = 0.25, kHalfWidth = 0.21;
constexpr double kCornerRoom = 0.03;  // kept free of the corners

const Limits kRound{.robot_radius = std::hypot(kHalfLength, kHalfWidth),
                    .margin = 0.1,
                    .safe_distance = 0.8,
                    .stop_distance = 0.15,
                    .max_speed = 0.4};
const Limits kLong = [] {
  Limits limits = kRound;
  limits.body = rectangle(2.0 * kHalfLength, 2.0 * kHalfWidth);
  limits.squeezes = true;
  limits.watches_goal = true;
  return limits;
}();

Vec2 at(double range, double bearing) { return {range * std::cos(bearing), range * std::sin(bearing)}; }

bool is_in_body(Vec2 echo, double radius) {
  return std::abs(echo.x) < kHalfLength + kCornerRoom && std::abs(echo.y) < kHalfWidth + kCornerRoom &&
         std::hypot(echo.x, echo.y) < radius + kCornerRoom;
}

// Turns the body to one side in small steps until the echo is within.
double turned_until_within(double range, double bearing, double side, double radius) {
  constexpr double kStep = 1e-4;
  for (double turned = 0.0; turned < 2.0 * pi; turned += kStep)
    if (is_in_body(at(range, bearing - side * turned), radius)) return turned;
  return std::numeric_limits<double>::infinity();
}

}  // namespace

TEST_CASE("a body passes between posts where its width finds room, but its circle does not", "[avoidance]") {
  const std::vector<Vec2> posts{{0.6, 0.33}, {0.6, -0.33}};
  CHECK(free_way(posts, 0.0, kLong) == kLong.safe_distance);
  CHECK(free_way(posts, 0.0, kRound) < 0.5);
  const std::vector<Vec2> narrow{{0.6, 0.30}, {0.6, -0.30}};
  CHECK(free_way(narrow, 0.0, kLong) < 0.6);
}

TEST_CASE("a robot squeezes only where no way for its circle is nearby", "[avoidance]") {
  const Situation situation{.goal = 0.0, .goal_distance = 3.0};
  const std::vector<Vec2> gate{{0.6, 0.33}, {0.6, -0.33}};
  CHECK(should_squeeze(gate, situation, kLong));
  CHECK_FALSE(should_squeeze({}, situation, kLong));
  const std::vector<Vec2> post{{0.6, 0.33}};  // 10 degrees to the right its circle passes
  CHECK(free_way(post, 0.0, kLong) == kLong.safe_distance);
  CHECK(free_way(post, 0.0, kRound) < 0.5);
  CHECK_FALSE(should_squeeze(post, situation, kLong));
}

TEST_CASE("straight ahead the way of a body ends where its front with its margin touches", "[avoidance]") {
  CHECK(free_way(std::vector<Vec2>{{0.7, 0.0}}, 0.0, kLong) == Approx(0.7 - kHalfLength - kLong.margin));
}

TEST_CASE("the room to turn ends where a corner, cut by the robot's circle, comes within 3 cm of an echo",
          "[avoidance]") {
  for (const double radius : {kRound.robot_radius, 0.29}) {
    Limits limits = kLong;
    limits.robot_radius = radius;
    orca::RandomStream random(1, "test", "turn");
    int limited = 0;
    const int cases = orca::test::part_of(2000);
    for (int i = 0; i < cases; ++i) {
      const double range = random.uniform(0.2, 0.4);
      const double bearing = random.uniform(-pi, pi);
      if (is_in_body(at(range, bearing), radius)) continue;
      CAPTURE(range, bearing);
      const TurnRoom room = turn_room(std::vector<Vec2>{at(range, bearing)}, {}, limits);
      const double left = turned_until_within(range, bearing, 1.0, radius);
      const double right = turned_until_within(range, bearing, -1.0, radius);
      if (std::isinf(left)) {
        CHECK(std::isinf(room.left));
        CHECK(std::isinf(room.right));
        continue;
      }
      ++limited;
      CHECK(room.left == Approx(left).margin(2e-4));
      CHECK(room.right == Approx(right).margin(2e-4));
    }
    CHECK(limited > cases / 10);
  }
}

TEST_CASE("an echo that is too near already lets only that corner turn away from it", "[avoidance]") {
  const std::vector<Vec2> beside_front{{0.15, kHalfWidth + 0.01}};
  const TurnRoom room = turn_room(beside_front, {}, kLong);
  CHECK_FALSE(room.allows(0.01));  // to the left, towards it
  CHECK(room.allows(-0.5));
  CHECK(room.allows(0.0));
  const TurnRoom mirrored = turn_room(std::vector<Vec2>{{0.15, -kHalfWidth - 0.01}}, {}, kLong);
  CHECK(mirrored.allows(0.5));
  CHECK_FALSE(mirrored.allows(-0.01));
}

TEST_CASE("who turns already has less room on that side, and a circle always has all", "[avoidance]") {
  const std::vector<Vec2> echo{at(0.32, 1.2)};
  const TurnRoom room = turn_room(echo, {}, kLong);
  const TurnRoom turning = turn_room(echo, {.turning = 0.1}, kLong);
  CHECK(turning.left == Approx(room.left - 0.1));
  CHECK(turning.right == Approx(room.right));
  CHECK(std::isinf(turn_room(echo, {}, kRound).left));
}

TEST_CASE("a robot whose corner would touch something speaks before it is turned to its goal",
          "[avoidance]") {
  const std::vector<Vec2> beside{at(0.345, 1.2)};
  const Advice advice = avoid(beside, {.goal = pi / 2, .goal_distance = 3.0}, kLong);
  REQUIRE(advice.needed);
  CHECK(advice.urgency > 0.9);
  CHECK(turn_room(beside, {}, kLong).allows(advice.direction));
  CHECK_FALSE(avoid(beside, {.goal = 0.0, .goal_distance = 3.0}, kLong).needed);
}

TEST_CASE("a way to the goal that is blocked needs advice although the way ahead is free", "[avoidance]") {
  const std::vector<Vec2> aside{{0.0, 0.7}};
  const Situation situation{.goal = pi / 2, .goal_distance = 3.0};
  CHECK(avoid(aside, situation, kLong).needed);
  Limits blind = kLong;
  blind.watches_goal = false;
  CHECK_FALSE(avoid(aside, situation, blind).needed);
  CHECK_FALSE(
      avoid(aside, {.goal = pi / 2, .goal_distance = 0.3}, kLong).needed);  // it stands behind the goal
}
