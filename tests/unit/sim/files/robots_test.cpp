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

TEST_CASE("the Pioneer with a gripper has it at the front edge of a Pioneer 2-DX, below its sensors",
          "[sim][robots]") {
  const RobotModel robot = shipped("pioneer_2dx_gripper");
  REQUIRE(robot.gripper);
  const Gripper& gripper = *robot.gripper;
  CHECK(gripper.mount.x == Approx(bounds_of(robot.footprint).high.x));
  CHECK(gripper.mount.y == 0.0);
  CHECK(gripper.mount.yaw == 0.0);
  CHECK(gripper.link == "gripper_link");
  CHECK(gripper.opening == Approx(0.22));
  CHECK(gripper.depth == Approx(0.1));
  CHECK(gripper.lift == Approx(0.08));
  CHECK(gripper.paddle_time == std::chrono::seconds(1));
  CHECK(gripper.lift_time == std::chrono::milliseconds(1500));
  CHECK(gripper.period == std::chrono::milliseconds(100));
  CHECK(gripper.label.vendor == "ActivMedia Robotics");
  const RobotModel plain = shipped("pioneer_2dx");
  CHECK_FALSE(plain.gripper);
  CHECK(robot.parts.size() == plain.parts.size());
  CHECK(robot.mass == plain.mass);
  CHECK(robot.drive.track == plain.drive.track);
  CHECK(robot.sonars.at(0).positions == plain.sonars.at(0).positions);
  CHECK(robot.sonars.at(0).height > shipped_world("store").items.at(0).height);
}

TEST_CASE("the Pioneer with a gripper fetches the can of the store by its beams, and carries it away",
          "[sim][robots]") {
  const WorldModel store = shipped_world("store");
  World world(store, {.seed = 1, .realism = Realism::nominal});
  const RobotId id =
      world.add_robot("dewey", shipped("pioneer_2dx_gripper"), store.place("shelf")->pose).value();
  const auto run_until = [&](auto done) {
    for (int i = 0; i < 1000 && !done(*world.gripper(id)); ++i) {
      world.step();
      REQUIRE(world.contacts().empty());
    }
    REQUIRE(done(*world.gripper(id)));
  };
  REQUIRE(world.set_velocity_command(id, 0.1, 0.0));
  run_until([](const GripperReading& g) { return g.inner_beam; });
  world.emergency_stop(id);
  REQUIRE(world.set_gripper_command(id, {Paddles::close, Lift::stay}));
  run_until([](const GripperReading& g) { return g.holds; });
  REQUIRE(world.set_gripper_command(id, {Paddles::stay, Lift::up}));
  run_until([](const GripperReading& g) { return g.lift == 1.0; });
  REQUIRE(world.set_velocity_command(id, -0.2, 0.0));
  run_until([&](const GripperReading&) { return world.pose(id).x < 5.0; });
  world.emergency_stop(id);
  REQUIRE(world.set_gripper_command(id, {Paddles::stay, Lift::down}));
  run_until([](const GripperReading& g) { return g.lift == 0.0; });
  REQUIRE(world.set_gripper_command(id, {Paddles::open, Lift::stay}));
  run_until([](const GripperReading& g) { return g.is_open; });
  CHECK(store.items.at(0).pose.x - world.item_pose("can")->x > 1.0);
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
