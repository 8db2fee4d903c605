// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "random_walk/walk.hpp"

using namespace orca::walk;

namespace {

constexpr Limits kLimits{.speed = 0.3,
                         .turn_rate = 0.8,
                         .least_turn = 0.8,
                         .greatest_turn = 2.4,
                         .blocked_at = 0.5,
                         .longest_way = 0.0};
constexpr double kLap = 0.05;
constexpr double kFree = 2.0;

// Returns the steps of a walk within 60 s when the way is blocked now and then.
std::vector<Step> minute(std::uint64_t seed, const Limits& limits = kLimits) {
  orca::RandomStream random(seed, "test", "walk");
  Walk walk;
  std::vector<Step> steps;
  for (int i = 0; i < 1200; ++i)
    steps.push_back(walk.step(i * kLap, i % 100 == 50 ? 0.4 : kFree, limits, random));
  return steps;
}

}  // namespace

TEST_CASE("it drives straight on for ever if the way is free and there is no longest way",
          "[components][walk]") {
  orca::RandomStream random(1, "test", "walk");
  Walk walk;
  for (int i = 0; i < 1000; ++i) {
    const Step step = walk.step(i * kLap, kFree, kLimits, random);
    CHECK(step.speed == kLimits.speed);
    CHECK(step.turn_rate == 0.0);
  }
}

TEST_CASE("when the way is blocked it turns on the spot by an angle between its limits, to either side",
          "[components][walk]") {
  orca::RandomStream random(2, "test", "walk");
  Walk walk;
  double time = 0.0;
  int left = 0;
  for (int turn = 0; turn < 200; ++turn) {
    double turned = 0.0;
    Step step = walk.step(time, 0.4, kLimits, random);
    while (step.speed == 0.0) {
      turned += step.turn_rate * kLap;
      time += kLap;
      step = walk.step(time, kFree, kLimits, random);
    }
    CHECK(std::abs(turned) >= kLimits.least_turn - 1e-9);
    CHECK(std::abs(turned) <= kLimits.greatest_turn + kLimits.turn_rate * kLap + 1e-9);
    left += turned > 0.0 ? 1 : 0;
  }
  CHECK(left > 60);
  CHECK(left < 140);
}

TEST_CASE("it never drives while the way is blocked", "[components][walk]") {
  orca::RandomStream random(3, "test", "walk");
  Walk walk;
  for (int i = 0; i < 1000; ++i) CHECK(walk.step(i * kLap, 0.5, kLimits, random).speed == 0.0);
}

TEST_CASE("with a longest way it turns before that time has passed, even if the way is free",
          "[components][walk]") {
  Limits limits = kLimits;
  limits.longest_way = 5.0;
  orca::RandomStream random(4, "test", "walk");
  Walk walk;
  double driven = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const Step step = walk.step(i * kLap, kFree, limits, random);
    driven = step.speed > 0.0 ? driven + kLap : 0.0;
    CHECK(driven <= limits.longest_way + kLap);
  }
}

TEST_CASE("the same stream gives the same walk, another stream another", "[components][walk]") {
  const auto same = [](const Step& a, const Step& b) {
    return a.speed == b.speed && a.turn_rate == b.turn_rate;
  };
  const std::vector<Step> walk = minute(7);
  const std::vector<Step> again = minute(7);
  const std::vector<Step> other = minute(8);
  CHECK(std::equal(walk.begin(), walk.end(), again.begin(), same));
  CHECK_FALSE(std::equal(walk.begin(), walk.end(), other.begin(), same));
}
