// SPDX-License-Identifier: GPL-3.0-or-later
// The memory of a CollisionMonitor for what sensors have seen.
#include "collision_monitor/surroundings.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace orca;
using namespace orca::gate;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A scan of 181 beams over the half plane ahead, all of which read the same.
Sweep scan(double range, double height = 0.3, const Pose2& X_OS = {}) {
  return {std::vector<double>(181, range), 8.0, -90 * kDegree, kDegree, X_OS, height};
}

Sweep scan_with(double range, std::size_t beam, double reading, double height = 0.3) {
  Sweep sweep = scan(range, height);
  sweep.ranges[beam] = reading;
  return sweep;
}

// A reading of a sonar in front of the robot.
Cone cone(std::size_t sonar, double range) {
  return {.sonar = sonar,
          .range = range,
          .farthest = 5.0,
          .half_angle = 10 * kDegree,
          .X_OS = {0.2, 0.0, 0.0},
          .place = {0.2, 0.0}};
}

}  // namespace

TEST_CASE("a beam that ends near the robot leaves a post at its end, and one without an echo none",
          "[gate]") {
  Surroundings seen;
  seen.see("laser", scan_with(8.0, 90, 1.5));
  const auto posts = seen.posts({1.0, 0.0, 90 * kDegree});
  REQUIRE(posts.size() == 1);
  CHECK(posts[0].place.x == Approx(0.0).margin(1e-12));
  CHECK(posts[0].place.y == Approx(-0.5));
  CHECK(posts[0].bottom == 0.0);
  CHECK(std::isinf(posts[0].top));
  CHECK(seen.source_of(0) == "laser");
}

TEST_CASE("what the robot is to touch does not count, and what is beside it does", "[gate]") {
  Surroundings seen;
  Sweep sweep = scan(8.0);
  sweep.ranges[90] = 0.8;
  sweep.ranges[60] = 0.8;
  seen.see("laser", sweep);
  CHECK(seen.posts({}).size() == 2);
  const auto posts = seen.posts({}, Disc{{0.8, 0.0}, 0.3});
  REQUIRE(posts.size() == 1);
  CHECK(posts[0].place.x == Approx(0.8 * std::cos(30 * kDegree)));
}

TEST_CASE("a scan replaces what it looks at, and keeps what is beside it or hidden", "[gate]") {
  Surroundings seen;
  seen.see("laser", scan_with(8.0, 90, 1.5));
  seen.see("laser", scan(8.0));
  CHECK(seen.posts({}).empty());
  seen.see("laser", scan_with(8.0, 90, 1.5));
  seen.see("laser", scan(8.0, 0.3, {0.0, 0.0, 180 * kDegree}));  // looks the other way
  CHECK(seen.posts({}).size() == 1);
  Sweep curtain = scan(8.0);
  std::fill(curtain.ranges.begin() + 85, curtain.ranges.begin() + 96, 0.7);
  seen.see("laser", curtain);
  CHECK(seen.posts({}).size() == 12);
}

TEST_CASE("a beam that has read nothing says nothing", "[gate]") {
  Surroundings seen;
  seen.see("laser", scan_with(8.0, 90, 1.5));
  seen.see("laser", scan_with(8.0, 90, std::nan("")));
  CHECK(seen.posts({}).size() == 1);
}

TEST_CASE("a scan of more beams than are kept at least counts as a whole", "[gate]") {
  Sweep fine = scan(1.5);
  fine.ranges.assign(3601, 1.5);
  fine.angle_increment = 0.05 * kDegree;
  Surroundings seen;
  seen.see("laser", fine);
  CHECK(seen.posts({}).size() == 3601);
  seen.see("laser", fine);
  CHECK(seen.posts({}).size() == 3601);
}

TEST_CASE("what is out of sight is forgotten after a while of driving", "[gate]") {
  Surroundings seen;
  seen.see("laser", scan_with(8.0, 90, 1.5));
  seen.age(0.9 * Surroundings::kKept, true);
  seen.age(100.0, false);
  CHECK(seen.posts({}).size() == 1);
  seen.age(0.2 * Surroundings::kKept, true);
  CHECK(seen.posts({}).empty());
}

TEST_CASE("an echo counts at all heights but for those at which another laser sees past it", "[gate]") {
  Surroundings seen;
  seen.see("low", scan_with(8.0, 90, 1.5, 0.1));
  seen.see("high", scan(8.0, 0.6));
  REQUIRE(seen.posts({}).size() == 1);
  CHECK(seen.posts({})[0].bottom == 0.0);
  CHECK(seen.posts({})[0].top == 0.6);  // a step
  seen.clear();
  seen.see("low", scan(8.0, 0.1));
  seen.see("high", scan_with(8.0, 90, 1.5, 0.6));
  REQUIRE(seen.posts({}).size() == 1);
  CHECK(seen.posts({})[0].bottom == 0.1);  // a table top
  CHECK(std::isinf(seen.posts({})[0].top));
}

TEST_CASE("an echo of a sonar may come from anywhere on the arc of its cone", "[gate]") {
  Surroundings seen;
  seen.hear("ring", cone(3, 1.0));
  const auto posts = seen.posts({});
  REQUIRE(posts.size() >= 9);
  for (const collision::Post& post : posts) CHECK(norm(post.place - Vec2{0.2, 0.0}) == Approx(1.0));
  CHECK(posts.front().place.y == Approx(-std::sin(10 * kDegree)));
  CHECK(posts.back().place.y == Approx(std::sin(10 * kDegree)));
}

TEST_CASE(
    "an echo that a sonar heard once is gone with its next reading, and the middle of one heard twice stays "
    "for a while",
    "[gate]") {
  Surroundings seen;
  seen.hear("ring", cone(3, 1.0));
  seen.hear("ring", cone(3, 5.0));
  CHECK(seen.posts({}).empty());
  seen.hear("ring", cone(3, 1.0));
  seen.hear("ring", cone(3, 0.95));
  CHECK(seen.posts({}).size() < 12);  // the second in place of the first
  seen.hear("ring", cone(3, 5.0));
  REQUIRE(seen.posts({}).size() == 1);  // the middle of the arc
  CHECK(norm(seen.posts({})[0].place - Vec2{1.15, 0.0}) < 0.03);
  seen.age(1.1 * Surroundings::kHeard, false);
  CHECK(seen.posts({}).empty());
}

TEST_CASE("something nearer than a sonar can measure is at the sonar, wherever the robot goes", "[gate]") {
  Surroundings seen;
  seen.hear("ring", cone(3, 0.0));
  REQUIRE(seen.posts({0.1, 0.0, 0.0}).size() == 1);
  CHECK(seen.posts({0.1, 0.0, 0.0})[0].place.x == 0.2);
  seen.hear("ring", cone(3, 5.0));
  CHECK(seen.posts({}).empty());
}

TEST_CASE("what was seen where somebody moves in sight is forgotten, and nothing else is", "[gate][people]") {
  Surroundings seen;
  Sweep sweep = scan_with(8.0, 90, 1.5);
  sweep.ranges[60] = 2.0;
  seen.see("laser", sweep);
  Passer passer{.place = {1.6, 0.0}, .velocity = {0.0, 0.1}};
  seen.forget(std::array{passer}, {});  // He stands.
  CHECK(seen.posts({}).size() == 2);
  passer.velocity.y = 1.0;
  seen.forget(std::array{passer}, {});
  CHECK(seen.posts({}).size() == 1);
}

TEST_CASE("who comes from beside is heard where no laser looks or shows the same, and not elsewhere",
          "[gate][people]") {
  const auto comers = [](double yaw, double shown) {
    Surroundings seen;
    Sweep sweep = scan(8.0);
    sweep.ranges[0] = shown;  // straight to the right
    double time = 0.0;
    for (const double range : {2.0, 1.6, 1.2}) {
      seen.see("laser", sweep);
      seen.hear_flank("ring", {7, time += 0.3, range, 5.0, {0.0, 0.0, yaw}}, 12 * kDegree);
    }
    return seen.comers(time, {}).size();
  };
  CHECK(comers(-130 * kDegree, 8.0) == 1);
  CHECK(comers(-90 * kDegree, 8.0) == 1);  // half of the cone is beside the field of view
  CHECK(comers(-90 * kDegree, 1.3) == 0);
  CHECK(comers(0.0, 8.0) == 0);
}
