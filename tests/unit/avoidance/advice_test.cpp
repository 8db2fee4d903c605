// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "orca/avoidance/advice.hpp"
#include "orca/base/random.hpp"

using namespace orca::avoid;
using Catch::Detail::Approx;
using orca::Vec2;
using std::numbers::pi;

namespace {

const Limits kAdviceLimits{.robot_radius = 0.2,
                           .margin = 0.1,
                           .side_distance = 0.2,
                           .safe_distance = 0.8,
                           .stop_distance = 0.15,
                           .max_speed = 0.4};
constexpr double kReach = 0.3;  // robot_radius + margin

std::vector<Vec2> random_echoes(orca::RandomStream& random) {
  std::vector<Vec2> echoes(random() % 17);
  for (Vec2& echo : echoes) {
    const double range = random.uniform(0.25, 3.0);
    const double angle = random.uniform(-pi, pi);
    echo = {range * std::cos(angle), range * std::sin(angle)};
  }
  return echoes;
}

// A wall across the way ahead, symmetric to it.
std::vector<Vec2> echoes_of_wall(double distance, double half_width) {
  std::vector<Vec2> echoes;
  for (double y = -half_width; y <= half_width + 1e-9; y += 0.1) echoes.push_back({distance, y});
  return echoes;
}

}  // namespace

TEST_CASE("the free way ends where the robot with its margin touches the echo", "[avoidance]") {
  const std::vector<Vec2> ahead{{0.7, 0.0}};
  CHECK(free_way(ahead, 0.0, kAdviceLimits) == Approx(0.7 - kReach));
  const std::vector<Vec2> aside{{0.7, 0.18}};
  CHECK(free_way(aside, 0.0, kAdviceLimits) == Approx(0.7 - std::sqrt(kReach * kReach - 0.18 * 0.18)));
  CHECK(free_way(ahead, pi / 2, kAdviceLimits) == kAdviceLimits.safe_distance);
}

TEST_CASE("a thing that stands alone is as wide as its foot may be, a wall or a row of posts is not",
          "[avoidance]") {
  std::vector<Vec2> mast{{1.0, -0.03}, {0.99, 0.0}, {1.0, 0.03}};
  add_feet(mast, 0.13);
  REQUIRE(mast.size() == 9);
  const auto widest = std::ranges::max_element(mast, {}, &Vec2::y);
  CHECK(widest->y == Approx(0.03 + 0.13).margin(0.01));
  CHECK(free_way(mast, 0.0, kAdviceLimits) == Approx(0.99 - kReach));
  std::vector<Vec2> wall{{1.0, 0.5}, {1.0, 0.25}, {1.0, 0.0}, {1.0, -0.25}, {1.0, -0.5}};
  std::vector<Vec2> posts{{1.0, 0.7}, {1.0, 0.0}, {1.0, -0.7}};
  for (std::vector<Vec2>* all : {&wall, &posts}) {
    const std::size_t seen = all->size();
    add_feet(*all, 0.13);
    CHECK(all->size() == seen);
  }
}

TEST_CASE("a near echo beside the way counts as a wall across its beam", "[avoidance]") {
  const double angle = 1.2;
  const double gap = 0.15;
  const std::vector<Vec2> near{{0.35 * std::cos(angle), 0.35 * std::sin(angle)}};
  CHECK(free_way(near, 0.0, kAdviceLimits) == Approx((gap - kAdviceLimits.margin) / std::cos(angle)));
  CHECK(free_way(near, angle - pi / 2, kAdviceLimits) == kAdviceLimits.safe_distance);
  const std::vector<Vec2> farther{{0.41 * std::cos(angle), 0.41 * std::sin(angle)}};
  CHECK(free_way(farther, 0.0, kAdviceLimits) == kAdviceLimits.safe_distance);
}

TEST_CASE("echoes behind, beside or far away leave the way free", "[avoidance]") {
  const std::vector<Vec2> echoes{{-0.1, 0.0}, {0.5, 1.01 * kReach}, {0.5, -1.01 * kReach}, {2.0, 0.0}};
  CHECK(free_way(echoes, 0.0, kAdviceLimits) == kAdviceLimits.safe_distance);
}

TEST_CASE("the free way lies between 0 and the safe distance, and another echo never makes it longer",
          "[avoidance]") {
  orca::RandomStream random(1, "test", "way");
  for (int i = 0; i < 1000; ++i) {
    std::vector<Vec2> echoes = random_echoes(random);
    const double direction = random.uniform(-pi, pi);
    const double before = free_way(echoes, direction, kAdviceLimits);
    CHECK(before >= 0.0);
    CHECK(before <= kAdviceLimits.safe_distance);
    echoes.push_back({random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)});
    CHECK(free_way(echoes, direction, kAdviceLimits) <= before);
  }
}

TEST_CASE("the way ahead is the shorter of straight on and where the robot will have turned to",
          "[avoidance]") {
  const std::vector<Vec2> ahead{{0.7, 0.0}};
  const std::vector<Vec2> left{{0.0, 0.5}};
  CHECK(way_ahead(ahead, {.turning = 1.5}, kAdviceLimits) == Approx(0.7 - kReach));
  CHECK(way_ahead(left, {.turning = pi / 2}, kAdviceLimits) == Approx(0.5 - kReach));
  CHECK(way_ahead(left, {}, kAdviceLimits) == kAdviceLimits.safe_distance);
}

TEST_CASE(
    "a free way leaves all of the speed from the safe distance on and nothing from the stop distance down",
    "[avoidance]") {
  CHECK(room(kAdviceLimits.safe_distance, kAdviceLimits) == 1.0);
  CHECK(room(0.5 * (kAdviceLimits.safe_distance + kAdviceLimits.stop_distance), kAdviceLimits) ==
        Approx(0.5));
  CHECK(room(kAdviceLimits.stop_distance, kAdviceLimits) == 0.0);
  CHECK(room(0.0, kAdviceLimits) == 0.0);
}

TEST_CASE("with a free way ahead there is no advice, whatever was advised before", "[avoidance]") {
  orca::RandomStream random(2, "test", "free");
  for (int i = 0; i < 1000; ++i) {
    const std::vector<Vec2> echoes = random_echoes(random);
    const bool free = free_way(echoes, 0.0, kAdviceLimits) >= kAdviceLimits.safe_distance;
    const Advice advice = avoid(echoes, {.last_direction = random.uniform(-2.0, 2.0)}, kAdviceLimits);
    CHECK(advice.needed == !free);
    if (free) CHECK((advice.direction == 0.0 && advice.speed == 0.0 && advice.urgency == 0.0));
  }
}

TEST_CASE("a robot that slides is advised as one that looks to its goal, whatever it looks at",
          "[avoidance]") {
  orca::RandomStream random(5, "test", "slides");
  Limits sliding = kAdviceLimits;
  sliding.slides = true;
  for (int i = 0; i < 1000; ++i) {
    const std::vector<Vec2> echoes = random_echoes(random);
    const double goal = random.uniform(-pi, pi);
    std::vector<Vec2> turned;
    for (const Vec2 echo : echoes) turned.push_back(rotated(echo, goal));
    const Advice looks = avoid(echoes, {.goal = 0.0}, kAdviceLimits);
    const Advice slides = avoid(turned, {.goal = goal}, sliding);
    REQUIRE(slides.needed == looks.needed);
    if (!slides.needed) continue;
    CHECK(slides.slides);
    CHECK(std::abs(orca::wrapped(slides.direction - looks.direction - goal)) < 1e-9);
    CHECK(slides.speed >= looks.speed - 1e-9);  // it need not turn first
    CHECK(slides.urgency == Approx(looks.urgency).margin(1e-9));
  }
}

TEST_CASE("what a sliding robot drifts into counts, even if the way to its goal is free", "[avoidance]") {
  Limits sliding = kAdviceLimits;
  sliding.slides = true;
  const std::vector<Vec2> beside{{0.0, 0.5}};
  CHECK_FALSE(avoid(beside, {.goal = 0.0}, sliding).needed);
  CHECK(avoid(beside, {.goal = 0.0, .course = pi / 2}, sliding).needed);
  CHECK(avoid(beside, {.course = pi / 2}, sliding).needed);
}

TEST_CASE("an advised direction is at least as free as the way ahead", "[avoidance]") {
  orca::RandomStream random(3, "test", "better");
  for (int i = 0; i < 1000; ++i) {
    const std::vector<Vec2> echoes = random_echoes(random);
    const Advice advice = avoid(echoes, {}, kAdviceLimits);
    if (!advice.needed) continue;
    CHECK(free_way(echoes, advice.direction, kAdviceLimits) >= free_way(echoes, 0.0, kAdviceLimits));
    CHECK(std::abs(advice.direction) <= pi + 1e-9);
  }
}

TEST_CASE("an obstacle on one side is avoided towards the other side", "[avoidance]") {
  const std::vector<Vec2> on_the_left{{0.7, 0.15}, {0.7, 0.25}};
  const std::vector<Vec2> on_the_right{{0.7, -0.15}, {0.7, -0.25}};
  const Advice right = avoid(on_the_left, {}, kAdviceLimits);
  const Advice left = avoid(on_the_right, {}, kAdviceLimits);
  CHECK(right.direction < 0.0);
  CHECK(left.direction == Approx(-right.direction));
  CHECK(left.speed == right.speed);
}

TEST_CASE("in front of something symmetric the side once chosen is kept", "[avoidance]") {
  for (const double half_width : {0.0, 0.2, 0.6}) {
    CAPTURE(half_width);
    for (double distance = 1.0; distance > 0.4; distance -= 0.02) {
      const std::vector<Vec2> echoes = echoes_of_wall(distance, half_width);
      const Advice left = avoid(echoes, {.last_direction = 0.3}, kAdviceLimits);
      const Advice right = avoid(echoes, {.last_direction = -0.3}, kAdviceLimits);
      CHECK(left.direction >= 0.0);
      CHECK(right.direction == -left.direction);
    }
    CHECK(avoid(echoes_of_wall(0.5, half_width), {.last_direction = 0.3}, kAdviceLimits).direction > 0.0);
  }
}

TEST_CASE("noise that shifts a symmetric obstacle a little does not change the side", "[avoidance]") {
  orca::RandomStream random(4, "test", "noise");
  double last = 0.0;
  for (int i = 0; i < 300; ++i) {
    std::vector<Vec2> echoes = echoes_of_wall(0.6, 0.3);
    for (Vec2& echo : echoes) echo.y += random.normal(0.0, 0.02);
    const Advice advice = avoid(echoes, {.last_direction = last}, kAdviceLimits);
    REQUIRE(advice.needed);
    CHECK(advice.direction * last >= 0.0);
    last = advice.direction;
  }
  CHECK(last != 0.0);
}

TEST_CASE(
    "the advice is slower and more urgent the nearer the obstacle is, down to speed 0 at the stop distance",
    "[avoidance]") {
  double last_speed = kAdviceLimits.max_speed;
  double last_urgency = 0.0;
  for (double ahead = 0.79; ahead > 0.0; ahead -= 0.01) {
    const std::vector<Vec2> echo{{ahead + kReach, 0.0}};
    const Advice advice = avoid(echo, {}, kAdviceLimits);
    REQUIRE(advice.needed);
    CHECK(advice.speed <= last_speed);
    CHECK(advice.urgency >= last_urgency);
    if (ahead <= kAdviceLimits.stop_distance) {
      CHECK(advice.speed == 0.0);
      CHECK(advice.urgency == 1.0);
    }
    last_speed = advice.speed;
    last_urgency = advice.urgency;
  }
}

TEST_CASE("the free direction nearest to the goal is chosen", "[avoidance]") {
  const std::vector<Vec2> ahead = echoes_of_wall(0.6, 0.2);
  const Advice left = avoid(ahead, {.goal = 1.2}, kAdviceLimits);
  const Advice right = avoid(ahead, {.goal = -1.2}, kAdviceLimits);
  REQUIRE(left.needed);
  CHECK(left.direction > 0.5);
  CHECK(right.direction == Approx(-left.direction));
}

TEST_CASE("a goal on the other side outweighs the side once chosen, a goal ahead does not", "[avoidance]") {
  const std::vector<Vec2> ahead = echoes_of_wall(0.6, 0.2);
  CHECK(avoid(ahead, {.last_direction = -0.5, .goal = 1.5}, kAdviceLimits).direction > 0.0);
  CHECK(avoid(ahead, {.last_direction = -0.5, .goal = 0.1}, kAdviceLimits).direction < 0.0);
}

TEST_CASE("beside a wall with the goal behind it, the robot goes the way that leads to the goal",
          "[avoidance]") {
  std::vector<Vec2> on_the_left;
  for (double x = -1.0; x <= 1.0; x += 0.1) on_the_left.push_back({x, 0.35});
  const double turning_left = 0.3;
  const Advice onwards = avoid(on_the_left, {.turning = turning_left, .goal = 1.2}, kAdviceLimits);
  const Advice back = avoid(on_the_left, {.turning = turning_left, .goal = 2.0}, kAdviceLimits);
  REQUIRE(onwards.needed);
  REQUIRE(back.needed);
  CHECK(std::abs(onwards.direction) < 0.3);
  CHECK(std::abs(back.direction) > 2.5);
}

TEST_CASE("mirrored worlds give mirrored advice", "[avoidance]") {
  orca::RandomStream random(5, "test", "mirror");
  for (int i = 0; i < 500; ++i) {
    std::vector<Vec2> echoes = random_echoes(random);
    const Situation here{random.uniform(-1.0, 1.0), random.uniform(-0.5, 0.5), random.uniform(-3.0, 3.0)};
    const Advice advice = avoid(echoes, here, kAdviceLimits);
    for (Vec2& echo : echoes) echo.y = -echo.y;
    const Advice mirrored = avoid(echoes, {-here.last_direction, -here.turning, -*here.goal}, kAdviceLimits);
    CHECK(mirrored.needed == advice.needed);
    CHECK(std::abs(orca::wrapped(mirrored.direction + advice.direction)) < 1e-9);
    CHECK(mirrored.speed == Approx(advice.speed));
  }
}
