// SPDX-License-Identifier: GPL-3.0-or-later
// Doors that open and shut while a world runs.
#include <catch2/catch.hpp>
#include <numbers>

#include "orca/sim/world.hpp"
#include "orca/sim/world_file.hpp"
#include "scout.hpp"
#include "shipped.hpp"

using namespace orca;
using namespace orca::sim;
using namespace orca::sim::test;
using std::chrono::seconds;

namespace {

using Notes = std::vector<std::string>;

// A door across the way from the middle of the room to its northern wall, 1 m wide, with its hinges in the west.
Door door() {
  return {.name = "door",
          .shut = {{-0.5, 3.0}, {0.5, 3.0}},
          .swing = std::numbers::pi / 2.0,
          .thickness = 0.04,
          .height = 2.0};
}

World world_of(Door one, std::vector<DoorTurn> turns = {}, std::vector<Walker> walkers = {},
               std::uint64_t seed = 1) {
  WorldModel model = test_room();
  model.doors = {std::move(one)};
  model.events.turns = std::move(turns);
  model.walkers = std::move(walkers);
  return World(std::move(model), {.seed = seed, .realism = Realism::ideal});
}

Notes turn_to(World& world, double time) {
  Notes happened;
  while (to_seconds(world.time() - TimePoint{}) < time - 1e-6) {
    world.step();
    happened.insert(happened.end(), world.happened().begin(), world.happened().end());
  }
  return happened;
}

// Distance to what stands on the line from (x, 0) to the north [m].
double see(const World& world, double x = 0.0) {
  return world.caster()
      .cast({.origin = {x, 0.0}, .direction = {0.0, 1.0}, .max_range = 10.0, .sensor_height = 0.5})
      .range;
}

constexpr double kLeaf = 2.98;  // [m] as see() finds it
constexpr double kBehind = 5.0;

}  // namespace

TEST_CASE("a door is shut at first, opens and shuts at its times, and takes 1.5 s for it", "[sim][door]") {
  World world = world_of(door(), {{"door", true, seconds(1)}, {"door", false, seconds(5)}});
  CHECK(turn_to(world, 1.0).empty());
  CHECK(see(world) == Approx(kLeaf));
  CHECK(turn_to(world, 4.9) == Notes{"door opens"});
  CHECK(see(world) == Approx(kBehind));
  CHECK(see(world, -0.5) == Approx(3.0).margin(0.02));  // the open leaf stands at its hinges
  CHECK(turn_to(world, 5.7) == Notes{"door shuts"});
  CHECK(see(world, 0.3) == Approx(kBehind));  // half open
  CHECK(turn_to(world, 6.7).empty());
  CHECK(see(world) == Approx(kLeaf));
  CHECK(see(world, 0.45) == Approx(kLeaf));
}

TEST_CASE("a sliding door opens along itself", "[sim][door]") {
  Door sliding = door();
  sliding.slides = true;
  World world = world_of(sliding, {{"door", true, seconds(1)}});
  (void)turn_to(world, 3.0);
  CHECK(see(world) == Approx(kBehind));
  CHECK(see(world, -1.0) == Approx(kLeaf));
}

TEST_CASE("a leaf stops at a robot, touches it not, and goes on when it has gone", "[sim][door]") {
  Door open = door();
  open.open = true;
  World world = world_of(open, {{"door", false, seconds(1)}});
  const RobotId robot = world.add_robot("scout", sim::test::scout(), {0.0, 3.0, 1.6}).value();
  CHECK(turn_to(world, 4.0) == Notes{"door shuts"});
  CHECK(world.clearance(robot, 1.0) < 0.05);
  CHECK(world.contacts().empty());
  REQUIRE(world.set_velocity_command(robot, -0.4, 0.0).ok());
  (void)turn_to(world, 8.0);
  CHECK(see(world) == Approx(kLeaf));
}

TEST_CASE("people open a door, and it shuts behind them where it has a closer", "[sim][door]") {
  const Walker anna{.name = "anna",
                    .track = {{0.0, -2.0}, {0.0, 4.0}},
                    .speed = 1.0,
                    .pause = seconds(0),
                    .start = seconds(0)};
  Door closing = door();
  closing.closer = seconds(1);
  World world = world_of(closing, {}, {anna});
  CHECK(turn_to(world, 4.0).empty());  // 1 m before it
  CHECK(turn_to(world, 5.0) == Notes{"door opens"});
  CHECK(turn_to(world, 7.0).empty());  // She turns round 1 m behind it ...
  CHECK(turn_to(world, 7.8).empty());  // ... and comes back before it shuts.
  CHECK(turn_to(world, 12.0) == Notes{"door shuts"});
  CHECK(see(world, 0.4) == Approx(kLeaf));
}

TEST_CASE("a door is opened and shut from outside as by an event, and stays open with a closer",
          "[sim][door]") {
  Door closing = door();
  closing.closer = seconds(1);
  World world = world_of(closing);
  CHECK(turn_door(world, "gate", true).error().code == Code::not_found);
  CHECK(turn_door(world, "door", false).error().code == Code::failed_precondition);
  REQUIRE(turn_door(world, "door", true).ok());
  CHECK(turn_door(world, "door", true).error().code == Code::failed_precondition);
  CHECK(doors_in(world).at(0).opens);
  (void)turn_to(world, 5.0);
  CHECK(see(world) == Approx(kBehind));
  const DoorState open = doors_in(world).at(0);
  CHECK(norm(open.leaf.a - Vec2{-0.5, 3.0}) == Approx(0.0).margin(1e-9));  // its hinges
  CHECK(norm(open.leaf.b - Vec2{-0.5, 4.0}) == Approx(0.0).margin(1e-9));
  REQUIRE(turn_door(world, "door", false).ok());
  (void)turn_to(world, 7.0);
  CHECK(see(world) == Approx(kLeaf));
}

TEST_CASE("a door that is shut from outside stops at a robot, and a person holds it open", "[sim][door]") {
  Door open = door();
  open.open = true;
  World world = world_of(open);
  const RobotId robot = world.add_robot("scout", sim::test::scout(), {0.0, 3.0, 1.6}).value();
  (void)turn_to(world, 0.1);
  REQUIRE(turn_door(world, "door", false).ok());
  (void)turn_to(world, 4.0);
  CHECK(world.contacts().empty());
  CHECK(see(world, 0.45) == Approx(kBehind));
  REQUIRE(world.set_velocity_command(robot, -0.4, 0.0).ok());
  (void)turn_to(world, 8.0);
  CHECK(see(world) == Approx(kLeaf));

  World held =
      world_of(open, {}, {{.name = "anna", .track = {{0.0, 2.5}, {0.0, -2.0}}, .start = seconds(0)}});
  (void)turn_to(held, 0.1);
  const Status refused = turn_door(held, "door", false);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().message == "anna is at the door and holds it open");
}

TEST_CASE("a drawn time of a door lies within its bounds and depends on the seed", "[sim][door]") {
  const auto opened_at = [](std::uint64_t seed) {
    World world = world_of(door(), {{"door", true, seconds(2), seconds(10)}}, {}, seed);
    while (world.happened().empty() && world.time() < TimePoint{} + seconds(20)) world.step();
    return to_seconds(world.time() - TimePoint{});
  };
  const double first = opened_at(1);
  CHECK(first >= 2.0);
  CHECK(first <= 10.02);
  CHECK(opened_at(1) == first);
  CHECK(opened_at(2) != first);
}

TEST_CASE("the doors of the office are no part of its map", "[sim][door]") {
  xml::Diagnostics diagnostics;
  const auto office = read_world(ORCA_SOURCE_DIR "/sim/worlds/office.xml", {}, diagnostics);
  const auto doors = read_world(ORCA_SOURCE_DIR "/sim/worlds/office_doors.xml", {}, diagnostics);
  REQUIRE((office && doors));
  CHECK(diagnostics.text() == "");
  CHECK(doors->doors.size() == 7);
  CHECK(doors->obstacles.size() == office->obstacles.size());
}
