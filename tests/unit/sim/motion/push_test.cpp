// SPDX-License-Identifier: GPL-3.0-or-later
// What happens to robots that touch: they slide, push, stall and are pushed, and nothing gets faster than what drives it.
#include <catch2/catch.hpp>

#include <algorithm>

#include "bases.hpp"
#include "motion/physics.hpp"
#include "orca/base/random.hpp"
#include "slow_run.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using namespace std::chrono_literals;
using orca::Pose2;
using orca::RandomStream;
using orca::Twist2;
using orca::Vec2;

namespace {

constexpr double kReach = 0.205;  // [m] Radius of the test's Scout.

RobotModel square_robot() {
  RobotModel model = base_of(DriveKind::differential);
  model.parts = {{Part::Block{0.4, 0.4, 0.3}, {.z = 0.2}}};
  model.footprint = footprint_of(model.parts);
  return model;
}

// Returns the plan of a robot in the world, smaller by 0.1 mm all round than it is.
Shape core_of(const World& world, RobotId robot, bool is_square) {
  const double less = 1e-4;
  const Shape own = is_square ? Shape(Box{{}, {0.2 - less, 0.2 - less}}) : Shape(Circle{{}, kReach - less});
  return placed(own, world.body_pose(robot));
}

// A walker that goes to and fro between two points, whatever is in its way.
Walker walker(Vec2 from, Vec2 to, double speed) {
  Walker made;
  made.name = "walker";
  made.track = {from, to};
  made.speed = speed;
  made.radius = 0.25;
  made.height = 1.8;
  made.stops = 0.0;
  return made;
}

WorldModel with_walker(const Walker& walker) {
  WorldModel model = test_room();
  model.walkers = {walker};
  return model;
}

}  // namespace

TEST_CASE("a base that grazes a wall at 1 deg slides along it at its speed, and keeps its heading",
          "[sim][contact][push]") {
  Bench bench(base_of(DriveKind::differential), Realism::ideal, {-4.0, 5.0 - kReach - 0.001, 0.017453});
  bench.drive({.forward = 0.4});
  bench.run(15.0);
  CHECK(bench.contacts == 1);
  CHECK(bench.velocity().forward == Approx(0.4).epsilon(0.02));
  CHECK(bench.pose().x == Approx(-4.0 + 0.4 * 15.0 - 0.5 * 0.4 * 0.4 / 0.76).margin(0.05));
  CHECK(bench.pose().yaw == Approx(0.017453).margin(0.02));
  CHECK(bench.pose().y <= 5.0 - kReach + 5e-5);
}

TEST_CASE("a base with a flat side that meets a wall at 10 deg lines up with it and goes on",
          "[sim][contact][push]") {
  Bench bench(square_robot(), Realism::ideal, {-4.0, 4.6, 10.0 * kDegree});
  bench.drive({.forward = 0.4});
  bench.run(12.0);
  CHECK(bench.contacts == 1);
  CHECK(std::fabs(bench.pose().yaw) < 0.01);
  CHECK(bench.velocity().forward == Approx(0.4).epsilon(0.02));
}

TEST_CASE("a base that meets a wall head on stands, its wheels too, and stays free to turn away",
          "[sim][contact][push]") {
  Bench bench(base_of(DriveKind::differential), Realism::nominal, {4.0, 3.0, 0.0});
  bench.drive({.forward = 0.5});
  bench.run(4.0);
  CHECK(bench.pose().x == Approx(5.0 - kReach).margin(1e-3));
  CHECK(std::fabs(bench.rolled().forward) < 0.02);
  bench.drive({.forward = 0.0, .turn_rate = 1.0});
  bench.run(3.0);
  bench.drive({.forward = 0.5});
  bench.run(3.0);
  CHECK(bench.pose().x < 4.3);
}

TEST_CASE("a walker pushes a base that stands, which is never faster than the walker",
          "[sim][contact][push]") {
  World world(with_walker(walker({-4, -2}, {4, -2}, 1.2)), {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", base_of(DriveKind::differential), {0.0, -2.0, 1.0});
  double fastest = 0.0;
  double farthest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    world.step();
    fastest = std::max(fastest, std::hypot(world.velocity(id).forward, world.velocity(id).left));
    farthest = std::max(farthest, norm(world.pose(id).position() - Vec2{0.0, -2.0}));
  }
  CHECK(farthest > 0.5);
  CHECK(fastest <= 1.2 * 1.001);
}

TEST_CASE("a walker that would press a base through a wall is stopped by it", "[sim][contact][push]") {
  World world(with_walker(walker({-4, -2}, {6, -2}, 1.2)), {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", base_of(DriveKind::differential), {4.6, -2.0, 0.0});
  for (int i = 0; i < 3000; ++i) {
    world.step();
    REQUIRE(world.pose(id).x <= 5.0 - kReach + 1e-4);
    REQUIRE(std::hypot(world.velocity(id).forward, world.velocity(id).left) <= 1.2 * 1.001);
  }
}

TEST_CASE("robots and walkers in a crowd never overlap, and none gets faster than the fastest drives",
          "[sim][contact][push]") {
  WorldModel model = test_room();
  model.obstacles.push_back({"leg", Circle{{-1.0, 1.0}, 0.01}, 1.0});
  model.obstacles.push_back({"plate", Box{{1.0, -1.5, 0.4}, {0.01, 0.5}}, 1.0});
  model.walkers = {walker({-4, -3}, {4, 3}, 1.0), walker({-3, 4}, {3, -4}, 0.8)};
  model.walkers[1].name = "other walker";
  World world(model, {.seed = 3, .realism = Realism::ideal});
  std::vector<RobotId> robots;
  RandomStream random(4, "test", "crowd");
  for (int k = 0; k < 8; ++k) {
    const RobotModel robot = k % 2 == 0 ? base_of(DriveKind::differential) : square_robot();
    robots.push_back(*world.add_robot("r" + std::to_string(k), robot, {-3.5 + k, -4.5 + 0.9 * (k % 3), 0.8}));
  }
  std::size_t touches = 0;
  const int ticks = orca::test::part_of(60'000);
  for (int i = 0; i < ticks; ++i) {
    if (i % 200 == 0)
      for (const RobotId r : robots)
        REQUIRE(world.set_velocity_command(r, random.uniform(-1.0, 1.0), random.uniform(-2.0, 2.0)));
    world.step();
    touches += world.contacts().size();
    std::vector<Shape> cores;
    for (std::size_t k = 0; k < robots.size(); ++k) cores.push_back(core_of(world, robots[k], k % 2 != 0));
    for (std::size_t k = 0; k < cores.size(); ++k)
      for (std::size_t other = 0; other < k; ++other) REQUIRE_FALSE(overlap(cores[k], cores[other]));
    if (i % 20 == 0)  // the walkers, and the posts
      for (const Circle& round : world.snapshot().circles)
        for (const Shape& core : cores) REQUIRE_FALSE(overlap(core, Shape(round)));
    for (const RobotId r : robots) {
      const Twist2 v = world.velocity(r);
      REQUIRE(std::hypot(v.forward, v.left) <= 1.0 * 1.001);
    }
  }
  CHECK(touches > static_cast<std::size_t>(ticks) / 240);
}

TEST_CASE("nothing passes through a thin post or plate, however fast", "[sim][contact]") {
  WorldModel model;
  model.obstacles.push_back({"leg", Circle{{1.0, 0.0}, 0.01}, 1.0});
  model.obstacles.push_back({"plate", Box{{-1.0, 0.0, 0.0}, {0.01, 0.5}}, 1.0});
  for (const double speed : {0.5, 3.0, 10.0, -0.5, -3.0, -10.0}) {
    orca::sim::detail::Physics physics(model);
    physics.add_robot(scout(), {0.001, 0.002, 0.0});
    for (int i = 0; i < 300; ++i) {
      physics.drive(0, {.velocity = {speed, 0.0}});
      physics.step(0.01);
    }
    CHECK(std::fabs(physics.pose(0).x) == Approx(0.99 - kReach).margin(1e-3));
    CHECK(physics.near_pairs().size() == 1);
  }
}

TEST_CASE("a robot at an obstacle's height touches it with the parts that are at that height",
          "[sim][contact]") {
  RobotModel model = base_of(DriveKind::differential);  // a low body and a thin column
  model.parts = {{Part::Cylinder{0.205, 0.3}, {.z = 0.2}}, {Part::Cylinder{0.05, 1.0}, {.z = 0.85}}};
  model.footprint = footprint_of(model.parts);
  const auto rests_at = [&](double bottom, double top) {
    WorldModel world;
    world.obstacles.push_back({"wall", Box{{2.0, 0.0, 0.0}, {0.1, 1.0}}, top, bottom});
    orca::sim::detail::Physics physics(world);
    physics.add_robot(model, {});
    for (int i = 0; i < 500; ++i) {
      physics.drive(0, {.velocity = {1.0, 0.0}});
      physics.step(0.01);
    }
    return physics.pose(0).x;
  };
  CHECK(rests_at(0.0, 1.0) == Approx(1.9 - 0.205).margin(1e-4));
  CHECK(rests_at(0.5, 1.0) == Approx(1.9 - 0.05).margin(1e-4));  // a table top, over the body
  CHECK(rests_at(1.4, 2.0) > 4.0);                               // a lamp, over all of it
  CHECK(rests_at(0.0, 0.04) > 4.0);                              // a sill, under the body
}

TEST_CASE("what is fixed stays where it is, whoever drives into it, and may stand in a wall",
          "[sim][contact][fixed]") {
  RobotModel post = base_of(DriveKind::differential);
  post.fixed = true;
  World world(test_room(), {.seed = 1, .realism = Realism::nominal});
  const Pose2 place{1.0, 0.0, 0.5};
  const RobotId fixed = world.add_robot("post", post, place).value();
  const RobotId robot = world.add_robot("robot", base_of(DriveKind::differential), {}).value();
  REQUIRE(world.set_velocity_command(robot, 0.5, 0.0));
  std::size_t contacts = 0;
  for (int tick = 0; tick < 1000; ++tick) {
    world.step();
    contacts += world.contacts().size();
  }
  CHECK(contacts == 1);
  CHECK(norm(world.pose(fixed).position() - place.position()) < 1e-6);
  CHECK(world.pose(robot).x < 1.0 - 2.0 * kReach + 0.001);
  CHECK_FALSE(world.set_velocity_command(fixed, 0.5, 0.0));
  CHECK_FALSE(world.add_robot("in a wall", base_of(DriveKind::differential), {0.0, 5.0, 0.0}));
  CHECK(world.add_robot("screwed to a wall", post, {0.0, 5.0, 0.0}));
}
