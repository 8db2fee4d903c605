// SPDX-License-Identifier: GPL-3.0-or-later
// When a moving outline touches a point, compared with small steps along the arc.
#include "orca/avoidance/footprint.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"
#include "slow_run.hpp"

using namespace orca::avoid;
using orca::Twist2;
using orca::Vec2;

namespace {

constexpr Footprint kRoundFootprint{.radius = 0.3};
constexpr Footprint kLongFootprint{.half_length = 0.25, .half_width = 0.2, .radius = 0.35};
constexpr double kTimeStep = 1e-3;  // [s]
constexpr double kTimeLimit = 6.0;  // [s]

// Returns when the gap first is gone, by walking along the arc; infinity if that is not within the limit.
double touched_by_steps(Vec2 point, const Twist2& motion, const Footprint& body) {
  for (double time = 0.0; time < kTimeLimit; time += kTimeStep)
    if (gap(seen_from(moved(motion, time), point), body) <= 0.0) return time;
  return std::numeric_limits<double>::infinity();
}

// Returns the smallest gap on the way there.
double smallest_gap(Vec2 point, const Twist2& motion, const Footprint& body, double until) {
  double smallest = std::numeric_limits<double>::infinity();
  for (double time = 0.0; time < until; time += kTimeStep)
    smallest = std::min(smallest, gap(seen_from(moved(motion, time), point), body));
  return smallest;
}

void check_against_steps(const Footprint& body, const char* name) {
  orca::RandomStream random(1, "test", name);
  int touched = 0;
  const int cases = orca::test::part_of(2000);
  for (int i = 0; i < cases; ++i) {
    const Vec2 point{random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8)};
    const Twist2 motion{random.uniform(0.0, 0.8), 0.0, random.uniform(-1.5, 1.5)};
    if (gap(point, body) <= 0.0) continue;
    INFO("point " << point.x << " " << point.y << ", motion " << motion.forward << " " << motion.turn_rate);
    const double time = time_to_touch(point, motion, body);
    const double stepped = touched_by_steps(point, motion, body);
    if (time < kTimeLimit - kTimeStep && std::isinf(stepped)) {
      // It only grazes the outline between two steps.
      CHECK(smallest_gap(point, motion, body, kTimeLimit) < 2e-3);
    } else if (std::isfinite(stepped)) {
      ++touched;
      CHECK(time <= stepped + 1e-9);
      // Whatever touches earlier than the steps say has grazed the outline before.
      if (time < stepped - kTimeStep) CHECK(smallest_gap(point, motion, body, stepped - kTimeStep) < 2e-3);
    }
  }
  CHECK(touched > cases / 10);
}

}  // namespace

TEST_CASE("a footprint touches a point when small steps along the arc say so", "[footprint]") {
  check_against_steps(kRoundFootprint, "round");
  check_against_steps(kLongFootprint, "long");
}

TEST_CASE("a footprint that drives straight on touches what is ahead of it and nothing beside it",
          "[footprint]") {
  const Twist2 ahead{0.5, 0.0, 0.0};
  CHECK(time_to_touch({1.25, 0.19}, ahead, kLongFootprint) == Approx(2.0));
  CHECK(std::isinf(time_to_touch({1.25, 0.21}, ahead, kLongFootprint)));
  CHECK(std::isinf(time_to_touch({-1.0, 0.0}, ahead, kLongFootprint)));
  CHECK(time_to_touch({1.3, 0.0}, ahead, kRoundFootprint) == Approx(2.0));
}

TEST_CASE("a circle can always turn on the spot, a rectangle until a corner touches", "[footprint]") {
  const Twist2 left{0.0, 0.0, 1.0};
  const Vec2 beside{0.0, 0.3};
  CHECK(std::isinf(time_to_touch({0.0, 0.31}, left, kRoundFootprint)));
  // The left side reaches it near its front corner.
  CHECK(time_to_touch(beside, left, kLongFootprint) == Approx(std::acos(0.2 / 0.3)));
  CHECK(std::isinf(time_to_touch({0.0, 0.33}, left, kLongFootprint)));
}

TEST_CASE("standing touches nothing", "[footprint]") {
  CHECK(std::isinf(time_to_touch({0.4, 0.0}, {}, kLongFootprint)));
}

TEST_CASE("the gap is the margin that just reaches a point, and its rate follows the motion", "[footprint]") {
  CHECK(gap({0.35, 0.0}, kLongFootprint) == Approx(0.1));
  CHECK(gap({0.0, -0.3}, kLongFootprint) == Approx(0.1));
  CHECK(gap({0.0, 0.4}, kRoundFootprint) == Approx(0.1));
  CHECK(gap({0.1, 0.1}, kLongFootprint) < 0.0);
  CHECK(gap_rate({0.35, 0.0}, {0.5, 0.0, 0.0}, kLongFootprint) == Approx(-0.5));
  CHECK(gap_rate({0.0, 0.3}, {0.5, 0.0, 0.0}, kLongFootprint) == 0.0);
  CHECK(gap_rate({0.2, 0.3}, {0.0, 0.0, 1.0}, kLongFootprint) == Approx(-0.2));
  CHECK(gap_rate({-0.2, 0.3}, {0.0, 0.0, 1.0}, kLongFootprint) == Approx(0.2));
  CHECK(gap_rate({0.4, 0.0}, {0.5, 0.0, 1.0}, kRoundFootprint) == Approx(-0.5));
}

TEST_CASE("a robot can stop from a motion that it can brake on the way that is left", "[footprint]") {
  constexpr Brakes kBrakes{.deceleration = 0.5, .turn_deceleration = 2.0};
  const double way = 0.36;
  const double fastest = std::sqrt(2.0 * way * kBrakes.deceleration);
  for (const double speed : {0.9 * fastest, 1.1 * fastest})
    CHECK(can_stop({speed, 0.0, 0.0}, way / speed, kBrakes) == (speed < fastest));
  for (const double side : {1.0, -1.0}) {
    CHECK(can_stop({0.0, 0.0, side}, 0.26, kBrakes));
    CHECK_FALSE(can_stop({0.0, 0.0, side}, 0.24, kBrakes));
  }
  CHECK(can_stop({}, -1.0, kBrakes));
}

TEST_CASE("of several echoes the one that is near first counts", "[footprint]") {
  const Twist2 ahead{0.5, 0.0, 0.0};
  const std::vector<Vec2> echoes{{2.0, 0.0}, {1.35, 0.0}, {-1.0, 0.0}};
  CHECK(time_to_margin(echoes, ahead, 0.1, kLongFootprint) == Approx(2.0));
  CHECK(std::isinf(time_to_margin(std::span<const Vec2>(), ahead, 0.1, kLongFootprint)));
}
