// SPDX-License-Identifier: GPL-3.0-or-later
// How far robots are from what they could touch, against sums that share no code with the simulator.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "orca/base/random.hpp"
#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using orca::Vec2;

namespace {

constexpr double kRadius = 0.205;  // [m] of the Scout
constexpr double kLimit = 2.0;     // [m]

// The distance from a place in the test room to its walls and its post.
double distance_in_room(Vec2 place) {
  return std::min(5.0 - std::max(std::fabs(place.x), std::fabs(place.y)), norm(place - Vec2{3.0, 0.0}) - 0.3);
}

// A world with a Scout there, after a tick.
struct StandingRobot {
  explicit StandingRobot(Vec2 place, WorldModel model = test_room()) : world(std::move(model), {}) {
    robot = *world.add_robot("dewey", scout(), {place.x, place.y, 0.3});
    world.step();
  }
  World world;
  RobotId robot{};
};

}  // namespace

TEST_CASE("the clearance is the distance to the nearest wall or post, up to the limit", "[sim][clearance]") {
  orca::RandomStream random(1, "test", "places");
  int far = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec2 place{random.uniform(-4.7, 4.7), random.uniform(-4.7, 4.7)};
    const double expected = distance_in_room(place) - kRadius;
    if (expected < 0.01) continue;
    const StandingRobot standing(place);
    CHECK(standing.world.clearance(standing.robot, kLimit) ==
          Approx(std::min(expected, kLimit)).margin(1e-9));
    far += expected > kLimit ? 1 : 0;
  }
  CHECK(far > 0);
}

TEST_CASE("other robots and obstacles that come and go count too", "[sim][clearance]") {
  StandingRobot standing({-2.0, 0.0});
  World& world = standing.world;
  const RobotId other = *world.add_robot("huey", scout(), {-1.0, 0.0, 0.0});
  world.step();
  CHECK(world.clearance(standing.robot, kLimit) == Approx(1.0 - 2.0 * kRadius));
  CHECK(world.clearance(other, kLimit) == Approx(1.0 - 2.0 * kRadius));
  const ObstacleId box = *world.add_obstacle("box", Box{{0, 0, 0}, {0.1, 0.1}}, 0.5, {-2.0, 0.5, 0.0});
  world.step();
  CHECK(world.clearance(standing.robot, kLimit) == Approx(0.4 - kRadius));
  REQUIRE(world.remove_obstacle(box).ok());
  world.step();
  CHECK(world.clearance(standing.robot, kLimit) == Approx(1.0 - 2.0 * kRadius));
}

TEST_CASE("what the robot passes under or over does not count", "[sim][clearance]") {
  WorldModel model = test_room();
  model.obstacles.push_back(
      {.name = "shelf", .shape = Box{{-2, 0.5, 0}, {0.2, 0.2}}, .height = 2.0, .bottom = 1.0});
  model.obstacles.push_back({.name = "doormat", .shape = Box{{-2, -0.5, 0}, {0.2, 0.2}}, .height = 0.02});
  const StandingRobot standing({-2.0, 0.0}, model);
  CHECK(standing.world.clearance(standing.robot, 1.0) == 1.0);
}

TEST_CASE("a look changes nothing", "[sim][clearance]") {
  StandingRobot watched({2.0, 0.5});
  StandingRobot alone({2.0, 0.5});
  for (int i = 0; i < 500; ++i) {
    for (StandingRobot* one : {&watched, &alone}) {
      REQUIRE(one->world.set_velocity_command(one->robot, 0.5, 0.4));
      one->world.step();
    }
    (void)watched.world.clearance(watched.robot, kLimit);
  }
  CHECK(watched.world.state_hash() == alone.world.state_hash());
}
