// SPDX-License-Identifier: GPL-3.0-or-later
// The situations of ND+ and their motion laws (see motion.hpp).
#include "nd_plus/motion.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/base/random.hpp"

using namespace orca::nd;
using orca::Vec2;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.3;  // [m]
constexpr Settings kSettings{.body = {.radius = 0.25},
                             .security_distance = 0.4,
                             .wide = kPi / 2,
                             .max_speed = 0.5,
                             .max_turn_rate = 1.0,
                             .least_share = 0.2,
                             .margin = 0.05,
                             .reaction = 0.1,
                             .brakes = {0.5, 2.0}};
constexpr Footprint kLongBody{.half_length = 0.4, .half_width = 0.2, .radius = 0.5};
constexpr Goal kAhead{0.0, 5.0};

// A wall `distance` [m] ahead, from y = right to y = left.
std::vector<Vec2> wall(double distance, double right, double left) {
  std::vector<Vec2> echoes;
  for (double y = right; y <= left + 1e-9; y += 0.05) echoes.push_back({distance, y});
  return echoes;
}

std::vector<Vec2> operator+(std::vector<Vec2> one, const std::vector<Vec2>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

std::vector<Vec2> mirrored(std::vector<Vec2> echoes) {
  for (Vec2& echo : echoes) echo.y = -echo.y;
  return echoes;
}

struct Answer {
  Situation situation;
  double direction;  // [rad]
  double share;
};

Answer answer_on(const std::vector<Vec2>& echoes, const Goal& goal = kAhead) {
  const auto area = free_walking_area(echoes, goal, kRadius);
  REQUIRE(area);
  const Dangers near = dangers(echoes, orca::portable::atan2(area->place.y, area->place.x), kSettings);
  return {situation(near, *area, kSettings.wide), motion_direction(near, *area, kRadius, kSettings),
          near.share()};
}

// Checks that the mirrored scene has the same situation and the mirrored direction.
void check_mirror(const std::vector<Vec2>& echoes, const Goal& goal = kAhead) {
  const Answer one = answer_on(echoes, goal);
  const Answer other = answer_on(mirrored(echoes), {-goal.direction, goal.distance});
  CHECK(one.situation == other.situation);
  CHECK(one.direction == Approx(-other.direction).margin(1e-9));
  CHECK(one.share == other.share);
}

}  // namespace

TEST_CASE("HSGR: with the goal in sight and nothing near the robot drives to it", "[nd]") {
  const Answer answer = answer_on({}, {0.4, 3.0});
  CHECK(answer.situation == Situation::high_safety_goal_in_region);
  CHECK(answer.direction == Approx(0.4));
  CHECK(answer.share == 1.0);
}

TEST_CASE("HSWR: past the edge of something before a wide region, at the security distance from the body",
          "[nd]") {
  const std::vector<Vec2> box = wall(1.5, -1.0, 0.4);
  const Answer answer = answer_on(box);
  CHECK(answer.situation == Situation::high_safety_wide_region);
  const double edge = std::atan2(0.4, 1.5);
  CHECK(answer.direction == Approx(edge + std::asin(0.7 / std::hypot(0.4, 1.5))).margin(2 * kSector));
  check_mirror(box);
}

TEST_CASE("HSNR: to the middle of a narrow region", "[nd]") {
  const std::vector<Vec2> doorway = wall(1.2, -2.0, 0.3) + wall(1.2, 1.1, 3.0);
  const Answer answer = answer_on(doorway);
  CHECK(answer.situation == Situation::high_safety_narrow_region);
  CHECK(answer.direction == Approx(0.5 * (std::atan2(0.3, 1.2) + std::atan2(1.1, 1.2))).margin(2 * kSector));
  check_mirror(doorway);
}

TEST_CASE("LSGR: to the goal, turned away from what is near on one side, the more the nearer it is", "[nd]") {
  const Answer far = answer_on({{0.2, 0.55}});
  const Answer near = answer_on({{0.2, 0.35}});
  CHECK(far.situation == Situation::low_safety_goal_in_region);
  CHECK(near.situation == Situation::low_safety_goal_in_region);
  CHECK(far.direction < 0.0);
  CHECK(near.direction < far.direction);
  check_mirror({{0.2, 0.55}});
}

TEST_CASE("LS1: as with high safety, turned away from what is near on one side", "[nd]") {
  const std::vector<Vec2> box = wall(1.5, -1.0, 0.4);
  const std::vector<Vec2> beside{{0.3, -0.45}};
  const Answer safe = answer_on(box);
  const Answer near = answer_on(box + beside);
  CHECK(near.situation == Situation::low_safety_1_side);
  CHECK(near.direction > safe.direction);
  check_mirror(box + beside);
}

TEST_CASE("LS2: between what is near on both sides, to the side where there is more room", "[nd]") {
  const auto between = [](double right, double left) { return answer_on({{0.3, -right}, {0.3, left}}); };
  const Answer middle = between(0.45, 0.45);
  CHECK(middle.situation == Situation::low_safety_2_sides);
  CHECK(middle.direction == Approx(0.0).margin(1e-9));
  CHECK(between(0.40, 0.50).direction > 0.0);
  CHECK(between(0.50, 0.40).direction < 0.0);
  CHECK(between(0.35, 0.50).direction > between(0.40, 0.50).direction);
  check_mirror({{0.3, -0.4}, {0.3, 0.5}});
}

TEST_CASE("what lies behind the way is no danger, whoever is within the security distance of the body is one",
          "[nd]") {
  CHECK(dangers(std::vector<Vec2>{{-0.5, 0.05}}, 0.0, kSettings).share() == 1.0);
  CHECK(dangers(std::vector<Vec2>{{0.66, 0.0}}, 0.0, kSettings).share() == 1.0);
  CHECK(dangers(std::vector<Vec2>{{0.45, 0.0}}, 0.0, kSettings).share() == Approx(0.5));
  CHECK(dangers(std::vector<Vec2>{{0.1, 0.0}}, 0.0, kSettings).share() == 0.0);
}

TEST_CASE("a rectangle needs a way of its width", "[nd]") {
  CHECK(half_way(kLongBody) == 0.2);
  CHECK(half_way({.radius = 0.5}) == 0.5);
}

TEST_CASE("the direction of motion is at most a right angle off", "[nd]") {
  CHECK(answer_on({}, {2.5, 3.0}).direction == Approx(kPi / 2));
  CHECK(answer_on({}, {-2.5, 3.0}).direction == Approx(-kPi / 2));
}

TEST_CASE(
    "the speed falls with the angle and with the nearness of danger, the turn rate grows with the angle",
    "[nd]") {
  CHECK(course(0.0, 1.0, kSettings).speed == Approx(0.5));
  CHECK(course(0.0, 1.0, kSettings).turn_rate == 0.0);
  CHECK(course(kPi / 4, 1.0, kSettings).speed == Approx(0.25));
  CHECK(course(kPi / 4, 1.0, kSettings).turn_rate == Approx(0.5));
  CHECK(course(-kPi / 2, 1.0, kSettings).speed == Approx(0.0));
  CHECK(course(-kPi / 2, 1.0, kSettings).turn_rate == Approx(-1.0));
  CHECK(course(0.0, 0.6, kSettings).speed == Approx(0.3));
  CHECK(course(kPi / 4, 0.6, kSettings).turn_rate == Approx(0.5));
  CHECK(course(0.0, 0.01, kSettings).speed == Approx(0.1));  // the least share
}

TEST_CASE("a course is safe if the robot can stop before the margin of its body meets something", "[nd]") {
  const auto ahead = [](double gap) { return std::vector<Vec2>{{0.25 + 0.05 + gap, 0.0}}; };
  const double way = 0.3 * 0.1 + 0.3 * 0.3 / (2 * 0.5);
  CHECK(is_safe({0.3, 0.0}, ahead(1.1 * way), kSettings));
  CHECK_FALSE(is_safe({0.3, 0.0}, ahead(0.9 * way), kSettings));
  CHECK(is_safe({0.0, 1.0}, ahead(0.0), kSettings));  // a circle has room to turn
}

TEST_CASE("a course that is not safe is driven more slowly, and keeps its turn", "[nd]") {
  const std::vector<Vec2> ahead{{0.45, 0.0}};
  const Course safe = made_safe({0.5, 0.3}, 1.0, 0.0, ahead, kSettings);
  CHECK(safe.turn_rate == 0.3);
  CHECK(safe.speed < 0.5);
  CHECK(is_safe(safe, ahead, kSettings));
  CHECK(made_safe({0.5, 0.3}, 1.0, 0.0, {}, kSettings).speed == 0.5);
}

TEST_CASE("driving has to be safe with the turn rate that the base still has", "[nd]") {
  const std::vector<Vec2> to_the_left{{0.3, 0.32}};
  CHECK(made_safe({0.4, -0.5}, 1.0, 0.0, to_the_left, kSettings).speed == 0.4);
  CHECK(made_safe({0.4, -0.5}, 1.0, 1.0, to_the_left, kSettings).speed < 0.4);
}

TEST_CASE("a body without room to turn goes on straight ahead", "[nd]") {
  Settings settings = kSettings;
  settings.body = kLongBody;
  const std::vector<Vec2> beside{{-0.3, -0.26}, {0.3, 0.26}};
  const Course out = made_safe(course(kPi / 2, 0.6, settings), 0.6, 0.0, beside, settings);
  CHECK(out.turn_rate < 0.6);
  CHECK(out.speed == Approx(0.3));
}

TEST_CASE("a body that is longer than wide stops where it still can turn away", "[nd]") {
  Settings settings = kSettings;
  settings.body = kLongBody;
  const std::vector<Vec2> ahead{{orca::avoid::reach(settings.body) + settings.margin + 0.01, 0.0}};
  CHECK(is_safe({0.02, 0.0}, ahead, settings));
  CHECK(made_safe({0.02, 1.0}, 1.0, 0.0, ahead, settings).speed == 0.0);
  CHECK(made_safe({0.02, 1.0}, 1.0, 0.0, ahead, settings).turn_rate == 1.0);
}

TEST_CASE("if nothing is safe the robot stands", "[nd]") {
  Settings settings = kSettings;
  settings.body = kLongBody;
  const std::vector<Vec2> close{{0.42, 0.1}, {0.42, -0.1}};
  const Course stand = made_safe({0.3, 0.5}, 0.0, 0.0, close, settings);
  CHECK(stand.speed == 0.0);
  CHECK(stand.turn_rate == 0.0);
}

TEST_CASE("from the speed to stop the robot comes to rest within the way", "[nd]") {
  CHECK(speed_to_stop(0.36, kSettings) == Approx(0.6));
  CHECK(speed_to_stop(0.0, kSettings) == 0.0);
  CHECK(speed_to_stop(-1.0, kSettings) == 0.0);
}

TEST_CASE("in random scenes a mirrored scene has the mirrored answer", "[nd]") {
  orca::RandomStream random(3, "test", "nd");
  int answered = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Vec2> echoes;
    for (int j = 0; j < 12; ++j)
      echoes.push_back(random.uniform(0.35, 2.0) * orca::direction(random.uniform(-kPi, kPi)));
    const Goal goal{random.uniform(-1.0, 1.0), 5.0};
    if (!free_walking_area(echoes, goal, kRadius)) continue;
    ++answered;
    check_mirror(echoes, goal);
  }
  CHECK(answered > 100);
}
