// SPDX-License-Identifier: GPL-3.0-or-later
// The robots that are shipped.
#include <catch2/catch.hpp>

#include "approval.hpp"
#include "bases.hpp"
#include "shipped.hpp"

using namespace orca::sim;
using orca::Vec2;
using namespace orca::sim::test;
using Catch::Contains;

TEST_CASE(
    "every shipped robot is read without a message, stands in the office and drives off without a contact",
    "[sim][robots]") {
  const auto files = orca::test::files_in(kRobots, ".urdf");
  REQUIRE(files.size() >= 6);
  for (const auto& file : files) {
    INFO(file.string());
    const RobotModel model = shipped(file.stem().string());
    World world(shipped_world("office"), {.seed = 1, .realism = Realism::nominal});
    const auto id = world.add_robot("dewey", model, world.model().place("start")->pose);
    REQUIRE(id);
    REQUIRE(world.set_velocity_command(*id, 0.3, 0.0));
    for (int tick = 0; tick < 300; ++tick) {
      world.step();
      REQUIRE(world.contacts().empty());
    }
    CHECK(norm(world.pose(*id).position() - world.model().place("start")->pose.position()) > 0.5);
  }
}

TEST_CASE("the inertia of every shipped robot is one that a body of its size can have", "[sim][robots]") {
  for (const auto& file : orca::test::files_in(kRobots, ".urdf")) {
    INFO(file.string());
    const RobotModel model = shipped(file.stem().string());
    // The bounds are that of all mass on the rim, and a tenth of it.
    const double rim = model.mass * model.bumper_radius * model.bumper_radius;
    CHECK(model.yaw_inertia < rim);
    CHECK(model.yaw_inertia > 0.1 * rim);
  }
}

TEST_CASE("the Pioneer 2-DX has the outline and the sonars of the maker's parameters", "[sim][robots]") {
  const RobotModel pioneer = shipped("pioneer_2dx");
  const Bounds plan = bounds_of(pioneer.footprint);
  CHECK(plan.high.x - plan.low.x == Approx(0.511));
  CHECK(plan.high.y - plan.low.y == Approx(0.425));
  CHECK(std::holds_alternative<Outline>(pioneer.footprint));
  CHECK(pioneer.drive.kind == DriveKind::differential);
  CHECK(pioneer.drive.max_turn_rate == Approx(500.0 * kDegree));
  CHECK(pioneer.drive.track == Approx(2.0 / 0.0056 / 1000.0).epsilon(1e-3));  // DiffConvFactor.
  const SonarRing& ring = pioneer.sonars.at(0);
  REQUIRE(ring.count == 16);
  const double angles[] = {90, 50, 30, 10, -10, -30, -50, -90, -90, -130, -150, -170, 170, 150, 130, 90};
  for (std::size_t k = 0; k < 16; ++k) CHECK(ring.transducer(k).yaw == Approx(angles[k] * kDegree));
  CHECK(ring.transducer(0).position() == Vec2{0.069, 0.136});
  CHECK(ring.transducer(12).position() == Vec2{-0.255, 0.027});
}

TEST_CASE("the Create 2 has the size of the maker's data sheet, and a laser that looks all around clockwise",
          "[sim][robots]") {
  const RobotModel create = shipped("create2");
  CHECK(std::get<Circle>(create.footprint).radius == Approx(0.17));
  CHECK(create.drive.max_turn_rate == Approx(2.0 * 0.5 / 0.235).epsilon(1e-3));  // one wheel ahead, one back
  const LaserScanner& laser = create.lasers.at(0);
  CHECK(laser.first_angle == Approx(std::numbers::pi));
  CHECK(static_cast<double>(laser.count) * laser.pitch == Approx(-2.0 * std::numbers::pi));
  CHECK(laser.height == Approx(0.135));
}

TEST_CASE("the PeopleBot has sonars at two heights", "[sim][robots]") {
  const RobotModel peoplebot = shipped("peoplebot");
  const SonarRing& ring = peoplebot.sonars.at(0);
  REQUIRE(ring.count == 24);
  CHECK(ring.height_of(0) == Approx(0.17));
  CHECK(ring.height_of(8) == Approx(1.0));
  CHECK(ring.height_of(16) == Approx(0.17));
  CHECK(ring.transducer(11).position() == Vec2{0.077, 0.027});
  CHECK(peoplebot.top > 1.0);
  const Bounds plan = bounds_of(peoplebot.footprint);
  CHECK(plan.high.x - plan.low.x == Approx(0.513));
}

TEST_CASE("a PeopleBot hears a table top above the sonars of its base", "[sim][robots]") {
  // A board at table height is a body whose bottom is above the lower ring: another robot, held in the air.
  RobotModel table = scout();
  table.parts = {{Part::Block{0.6, 0.6, 0.5}, {.x = 0.0, .y = 0.0, .z = 0.95}}};
  table.footprint = footprint_of(table.parts);
  std::tie(table.bottom, table.top) = height_range_of(table.parts);
  table.sonars.clear();
  Bench bench(shipped("peoplebot"), Realism::ideal, {-2.0, 0.0, 0.0});
  REQUIRE(bench.world.add_robot("table", table, {-0.5, 0.0, 0.0}));
  while (!bench.world.sonar(bench.id)) bench.run(0.01);
  const SonarScan scan = *bench.world.sonar(bench.id);
  CHECK(scan.readings[11].range < 1.2);  // Upper ring, ahead.
  CHECK(scan.readings[3].range > 2.0);   // Lower ring, ahead: under the table.
}

TEST_CASE("the BARN base is a rectangle of the benchmark's size", "[sim][robots]") {
  const Bounds plan = bounds_of(shipped("barn_base").footprint);
  CHECK(plan.high.x - plan.low.x == Approx(0.508));
  CHECK(plan.high.y - plan.low.y == Approx(0.430));
}

TEST_CASE("the Nomad 200 is a synchro base with its sonars on a turret", "[sim][robots]") {
  const RobotModel nomad = shipped("nomad_200");
  CHECK(nomad.drive.kind == DriveKind::synchro);
  REQUIRE(nomad.turret);
  CHECK(nomad.turret->axis == Vec2{0.0, 0.0});
  CHECK(nomad.sonars.at(0).on_turret);
  CHECK(std::get<Circle>(nomad.footprint).radius == Approx(0.24));
}

TEST_CASE("the Omni moves sideways", "[sim][robots]") {
  Bench bench(shipped("omni"), Realism::ideal);
  bench.drive({.left = 0.3});
  bench.run(5.0);
  CHECK(bench.pose().y > 1.2);
  CHECK(bench.pose().x == Approx(0.0).margin(1e-9));
}

TEST_CASE("a polygon is refused where a corner would be in a wall, and taken where it just fits",
          "[sim][robots]") {
  World world(test_room(), {.seed = 1, .realism = Realism::ideal});
  const RobotModel pioneer = shipped("pioneer_2dx");
  // At 0.25 m from the wall half the robot's width fits, but not the length of its back.
  CHECK(world.add_robot("beside", pioneer, {4.75, 2.0, 0.5 * std::numbers::pi}));
  const auto refused = world.add_robot("behind", pioneer, {4.75, -2.0, std::numbers::pi});
  REQUIRE_FALSE(refused);
  CHECK_THAT(refused.error().message, Contains("would stand in obstacle 'east'"));
  CHECK(world.add_robot("before", pioneer, {4.75, -2.0, 0.0}));
  CHECK_THAT(world.add_robot("on_it", pioneer, {4.75, -1.7, 0.0}).error().message,
             Contains("would stand in robot 'before'"));
}

TEST_CASE("a polygon touches walls with its own front and back", "[sim][robots][contact]") {
  struct Case {
    const char* robot;
    double speed;
    double reach;
  };
  const auto [robot, speed, reach] =
      GENERATE(Case{"pioneer_2dx", 0.5, 0.211}, Case{"pioneer_2dx", -0.5, 0.300},
               Case{"barn_base", 0.5, 0.254}, Case{"barn_base", -0.5, 0.254});
  Bench bench(shipped(robot), Realism::ideal, {0.0, 3.0, 0.0});
  bench.drive({.forward = speed});
  bench.run(12.0);
  CHECK(bench.contacts == 1);
  CHECK(std::fabs(bench.pose().x) == Approx(5.0 - reach).margin(0.005));
}
