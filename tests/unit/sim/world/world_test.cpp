// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/base/hash.hpp"
#include "orca/base/random.hpp"
#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using orca::Pose2;
using namespace orca::sim::test;

namespace {

void run(World& world, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) world.step();
}

World world_with_scout(RobotId& id, Realism realism, Pose2 start = {}) {
  World world(test_room(), {.seed = 1, .realism = realism});
  const auto added = world.add_robot("dewey", scout(), start);
  REQUIRE(added);
  id = *added;
  return world;
}

// One minute of driving into things, by commands drawn from their own stream; returns the hash of every tick.
std::uint64_t rough_minute(std::uint64_t seed, Realism realism = Realism::nominal) {
  World world(test_room(), {.seed = seed, .realism = realism});
  const RobotId a = *world.add_robot("a", scout(), {});
  const RobotId b = *world.add_robot("b", scout(), {1.5, 1.0, 2.0});
  orca::RandomStream drive(5, "test", "commands");
  orca::Fnv1a trace;
  std::size_t touches = 0;
  for (int i = 0; i < 6000; ++i) {
    // Ahead until something is in the way, then back and round.
    for (const RobotId r : {a, b}) {
      if (i % 750 == 0)
        REQUIRE(world.set_velocity_command(r, drive.uniform(0.6, 1), drive.uniform(-0.1, 0.1)));
      if (i % 750 == 650) REQUIRE(world.set_velocity_command(r, -0.5, drive.uniform(0.8, 2)));
    }
    world.step();
    touches += world.contacts().size();
    trace.add_u64(world.state_hash());
    if (const auto& scan = world.sonar(a))
      for (const SonarReading& reading : scan->readings)
        trace.add_u64(static_cast<std::uint64_t>(reading.range * 1e9));
  }
  REQUIRE(touches >= 5);
  return trace.value();
}

}  // namespace

TEST_CASE("an obstacle whose outline has no edges is nothing to run into or to see", "[sim][world]") {
  WorldModel model = test_room();
  model.obstacles.push_back({"blank", Outline{}, 1.0});
  World world(model, {.seed = 1, .realism = Realism::ideal});
  const auto id = world.add_robot("dewey", scout(), {});
  REQUIRE(id);
  REQUIRE(world.set_velocity_command(*id, 0.5, 0.0));
  run(world, 1.0);
  CHECK(world.contacts().empty());
  CHECK(world.pose(*id).x > 0.2);
}

TEST_CASE("time is ticks of exactly 10 ms", "[sim][world]") {
  World world(WorldModel{}, {});
  run(world, 1.0);
  CHECK(world.time().time_since_epoch() == std::chrono::seconds{1});
}

TEST_CASE("two fresh worlds with one seed stay bit-identical through a minute of collisions",
          "[sim][world]") {
  CHECK(rough_minute(7) == rough_minute(7));
  CHECK(rough_minute(7) != rough_minute(8));
}

TEST_CASE("at ideal realism the seed has no influence", "[sim][world]") {
  CHECK(rough_minute(7, Realism::ideal) == rough_minute(8, Realism::ideal));
}

TEST_CASE("another robot's arrival leaves a robot's own noise unchanged", "[sim][world]") {
  const auto odometry_after = [](bool with_other) {
    World world(test_room(), {.seed = 3, .realism = Realism::nominal});
    if (with_other) REQUIRE(world.add_robot("other", scout(), {-3, -3, 0}));
    const RobotId id = *world.add_robot("dewey", scout(), {});
    REQUIRE(world.set_velocity_command(id, 0.2, 0.5));
    run(world, 5.0);
    return world.odometry(id).value().pose;
  };
  CHECK(odometry_after(false) == odometry_after(true));
}

TEST_CASE("a small command is followed after the dead time with the drive's first-order lag",
          "[sim][drive]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::nominal);
  REQUIRE(world.set_velocity_command(id, 0.05, 0.0));
  run(world, 0.05);
  CHECK(world.velocity(id).forward == 0.0);
  for (int n = 1; n <= 30; ++n) {
    world.step();  // The odometer reports at every fifth.
    if (world.odometry(id))
      CHECK(world.odometry(id)->velocity.forward ==
            Approx(0.05 * (1.0 - std::exp(-n * 0.01 / 0.1))).margin(1e-12));
  }
}

TEST_CASE("a large command is followed with the acceleration limit up to the speed limit", "[sim][drive]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::ideal, {-4, 2, 0});
  REQUIRE(world.set_velocity_command(id, 3.0, 0.0));
  run(world, 1.0);
  CHECK(world.velocity(id).forward == Approx(0.76));
  run(world, 1.0);
  CHECK(world.velocity(id).forward == Approx(1.0));
}

TEST_CASE("a base that drives and turns follows the exact arc", "[sim][drive]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::ideal);
  REQUIRE(world.set_velocity_command(id, 0.0076, 0.04));  // Reached in one tick.
  run(world, 10.0);
  const double radius = 0.0076 / 0.04;
  const Pose2 pose = world.pose(id);
  CHECK(pose.yaw == Approx(0.4).margin(1e-12));
  CHECK(pose.x == Approx(radius * std::sin(0.4)).margin(1e-12));
  CHECK(pose.y == Approx(radius * (1.0 - std::cos(0.4))).margin(1e-12));
}

TEST_CASE("a command that is not finite is refused and the former one stays", "[sim][drive]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::ideal);
  REQUIRE(world.set_velocity_command(id, 0.1, 0.0));
  CHECK_FALSE(world.set_velocity_command(id, std::nan(""), 0.0));
  run(world, 1.0);
  CHECK(world.velocity(id).forward == Approx(0.1));
}

TEST_CASE("a wall stops the robot, and the contact is reported once, with the wall's name",
          "[sim][contact]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::nominal, {0, 3, 0});
  REQUIRE(world.set_velocity_command(id, 0.8, 0.0));
  std::vector<ContactEvent> events;
  for (int i = 0; i < 1500; ++i) {
    world.step();
    const double gap = 5.0 - (world.pose(id).x + 0.205);
    CHECK(gap > -0.005);
    if (!world.contacts().empty()) CHECK(gap < 0.001);
    events.insert(events.end(), world.contacts().begin(), world.contacts().end());
  }
  REQUIRE(events.size() == 1);
  CHECK(events[0].robot == "dewey");
  CHECK(events[0].other == "east");
  CHECK(events[0].speed == Approx(0.8).margin(0.01));
  CHECK(std::fabs(world.velocity(id).forward) < 0.01);
}

TEST_CASE("backing off and coming again is a second contact", "[sim][contact]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::nominal, {4, 3, 0});
  std::size_t contacts = 0;
  const auto drive = [&](double speed, int ticks) {
    REQUIRE(world.set_velocity_command(id, speed, 0.0));
    for (int i = 0; i < ticks; ++i) {
      world.step();
      contacts += world.contacts().size();
    }
  };
  drive(0.5, 300);
  CHECK(contacts == 1);
  drive(-0.5, 300);
  CHECK(contacts == 1);
  CHECK(world.pose(id).x < 4.7);
  drive(0.5, 500);
  CHECK(contacts == 2);
}

TEST_CASE("a robot that drives and turns in the open has no contact", "[sim][contact]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::nominal, {0, 1, 0});
  REQUIRE(world.set_velocity_command(id, 0.5, 0.6));
  for (int i = 0; i < 3000; ++i) {
    world.step();
    REQUIRE(world.contacts().empty());
  }
}

TEST_CASE("two robots that meet both report a contact, and neither passes through the other",
          "[sim][contact]") {
  World world(test_room(), {.seed = 1, .realism = Realism::ideal});
  const RobotId a = *world.add_robot("a", scout(), {-2, -2, 0});
  const RobotId b = *world.add_robot("b", scout(), {0, -2, std::numbers::pi});
  REQUIRE(world.set_velocity_command(a, 0.5, 0.0));
  REQUIRE(world.set_velocity_command(b, 0.5, 0.0));
  std::vector<std::string> told;
  for (int i = 0; i < 500; ++i) {
    world.step();
    for (const ContactEvent& e : world.contacts()) told.push_back(e.robot + "-" + e.other);
  }
  CHECK(told == std::vector<std::string>{"a-b", "b-a"});
  CHECK(world.pose(b).x - world.pose(a).x > 0.40);
}

TEST_CASE("the boundary of a bitmap stops a robot like a wall does", "[sim][contact]") {
  WorldModel model;
  model.obstacles.push_back({"map", outline_of({{1, -2}, {2, -2}, {2, 2}, {1, 2}}), 2.5});
  World world(model, {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("a", scout(), {});
  REQUIRE(world.set_velocity_command(id, 1.0, 0.0));
  std::size_t contacts = 0;
  for (int i = 0; i < 1000; ++i) {
    world.step();
    contacts += world.contacts().size();
  }
  CHECK(contacts == 1);
  CHECK(world.pose(id).x == Approx(0.795).margin(0.005));
}

TEST_CASE("odometry is exact at ideal realism and drifts at nominal", "[sim][odometry]") {
  for (const Realism realism : {Realism::ideal, Realism::nominal}) {
    RobotId id{};
    World world = world_with_scout(id, realism, {-2, -2, 0.5});
    REQUIRE(world.set_velocity_command(id, 0.4, 0.3));
    run(world, 20.0);
    const Pose2 believed = Pose2{-2, -2, 0.5} * world.odometry(id).value().pose;
    const double error = norm(believed.position() - world.pose(id).position());
    if (realism == Realism::ideal) CHECK(error < 1e-9);
    if (realism == Realism::nominal) CHECK(error > 0.005);
    if (realism == Realism::nominal) CHECK(error < 1.0);
  }
}

TEST_CASE("odometry comes with its period and the stamp of its tick", "[sim][odometry]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::ideal);
  for (int tick = 1; tick <= 20; ++tick) {
    world.step();
    REQUIRE(world.odometry(id).has_value() == (tick % 5 == 0));
    if (world.odometry(id)) CHECK(world.odometry(id)->stamp == world.time());
  }
}

TEST_CASE("a robot is not set down in a wall, in another robot, without a name or twice", "[sim][world]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::ideal);
  const auto error = [&](const std::string& name, Pose2 pose) {
    const auto added = world.add_robot(name, scout(), pose);
    return added ? "" : added.error().message;
  };
  CHECK(
      error("huey", {4.9, 1.0, 0.0}) ==
      "robot 'huey' cannot stand at (4.90, 1.00) m: it would stand in obstacle 'east' of world 'test room'; "
      "choose a free place");
  CHECK_THAT(error("huey", {3.0, 0.1, 0.0}), Catch::Contains("obstacle 'post'"));
  CHECK_THAT(error("huey", {0.3, 0.0, 0.0}), Catch::Contains("would stand in robot 'dewey'"));
  CHECK_THAT(error("dewey", {1.0, 1.0, 0.0}), Catch::Contains("already"));
  CHECK_THAT(error("", {1.0, 1.0, 0.0}), Catch::Contains("needs a name"));
  CHECK_THAT(error("huey", {std::nan(""), 1.0, 0.0}), Catch::Contains("not finite"));
  CHECK(error("huey", {1.0, 1.0, 0.0}).empty());
  CHECK(world.find("huey") == RobotId{1});
  CHECK_FALSE(world.find("louie").has_value());
}

TEST_CASE("a snapshot holds the world's edges and circles, its places and the way the robot came",
          "[sim][snapshot]") {
  RobotId id{};
  World world = world_with_scout(id, Realism::ideal, {-2, -2, 0});
  world.keep_trajectory(id);
  REQUIRE(world.set_velocity_command(id, 0.5, 0.0));
  run(world, 3.0);
  const Snapshot snapshot = world.snapshot();
  CHECK(snapshot.edges.size() == 16);
  CHECK(snapshot.circles.size() == 1);
  CHECK(snapshot.bounds.low.x == Approx(-5.2));
  REQUIRE(snapshot.robots.size() == 1);
  const auto& way = snapshot.robots[0].trajectory;
  REQUIRE(way.size() > 20);
  CHECK(way.front().pose == Pose2{-2, -2, 0});
  CHECK(way.back().pose == world.pose(id));
  for (std::size_t i = 1; i < way.size(); ++i)
    CHECK(norm(way[i].pose.position() - way[i - 1].pose.position()) < 0.06);
  CHECK(std::get<Circle>(snapshot.robots[0].footprint).center == world.pose(id).position());
}
