// SPDX-License-Identifier: GPL-3.0-or-later
// Batteries that lose charge, are charged, and are drained.
#include <catch2/catch.hpp>

#include <cmath>
#include <utility>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca;
using namespace orca::sim;
using namespace orca::sim::test;
using std::chrono::seconds;

namespace {

constexpr Battery kBattery{.voltage = 12.0,
                           .driving = seconds(100),
                           .standing = seconds(400),
                           .charging = seconds(50),
                           .period = seconds(1)};

/// A Scout with a small battery in the middle of the room.
struct Room {
  explicit Room(Events events = {}, std::vector<Charger> chargers = {})
      : world(make(std::move(events), std::move(chargers))) {
    RobotModel model = scout();
    model.battery = kBattery;
    robot = world.add_robot("Scout", model, {}).value();
  }

  static World make(Events events, std::vector<Charger> chargers) {
    WorldModel model = test_room();
    model.events = std::move(events);
    model.chargers = std::move(chargers);
    return World(std::move(model), {.seed = 1, .realism = Realism::ideal});
  }

  void run(double time) {
    for (int tick = 0; tick < std::lround(time / 0.01); ++tick) world.step();
  }
  [[nodiscard]] double charge() const { return battery_in(world, robot)->charge; }

  World world;
  RobotId robot{};
};

}  // namespace

TEST_CASE("a battery is full at first, and lasts as long at rest as its file says", "[sim][battery]") {
  Room room;
  CHECK(room.charge() == 1.0);
  CHECK(battery_in(room.world, room.robot)->voltage == Approx(12.0));
  room.run(100.0);
  CHECK(room.charge() == Approx(0.75));
  CHECK(battery_in(room.world, room.robot)->voltage == Approx(11.5));
  CHECK_FALSE(battery_in(room.world, room.robot)->charging);
}

TEST_CASE("a robot that drives empties its battery faster, in proportion to its speed", "[sim][battery]") {
  Room room;
  REQUIRE(room.world.set_velocity_command(room.robot, 0.0, 0.0).ok());
  const double most = room.world.robot_model(room.robot).drive.max_speed;
  REQUIRE(room.world.set_velocity_command(room.robot, 0.5 * most, 1.0).ok());  // in a circle
  room.run(40.0);
  CHECK(room.charge() == Approx(1.0 - 40.0 * 0.5 * (1.0 / 400.0 + 1.0 / 100.0)).margin(0.01));
}

TEST_CASE("an empty battery stops the robot for good", "[sim][battery]") {
  Room room({.drains = {{"Scout", seconds(2), 0.0}}});
  REQUIRE(room.world.set_velocity_command(room.robot, 0.3, 0.0).ok());
  room.run(2.0);
  CHECK(room.world.velocity(room.robot).forward == Approx(0.3).margin(0.01));
  room.run(3.0);
  CHECK(room.world.velocity(room.robot).forward == Approx(0.0).margin(1e-6));
  REQUIRE(room.world.set_velocity_command(room.robot, 0.3, 0.0).ok());
  room.run(3.0);
  CHECK(room.world.velocity(room.robot).forward == Approx(0.0).margin(1e-6));
  CHECK(room.charge() == 0.0);
}

TEST_CASE("a robot that rests at a charger is charged, one that passes or rests beside it is not",
          "[sim][battery]") {
  const std::vector<Charger> here{{"dock", {0.0, 0.0, 0.0}, 0.2}};
  Room room({.drains = {{"Scout", seconds(1), 0.2}}}, here);
  room.run(11.0);
  CHECK(room.charge() == Approx(0.2 + 10.0 * (1.0 / 50.0 - 1.0 / 400.0)).margin(0.001));
  CHECK(battery_in(room.world, room.robot)->charging);
  room.run(60.0);
  CHECK(room.charge() == 1.0);

  Room turning({.drains = {{"Scout", seconds(1), 0.2}}}, here);
  REQUIRE(turning.world.set_velocity_command(turning.robot, 0.1, 1.0).ok());  // in a circle of 0.1 m
  turning.run(11.0);
  CHECK_FALSE(battery_in(turning.world, turning.robot)->charging);
  CHECK(turning.charge() < 0.2);

  Room beside({}, {{"dock", {0.5, 0.0, 0.0}, 0.2}});
  beside.run(1.0);
  CHECK_FALSE(battery_in(beside.world, beside.robot)->charging);
}

TEST_CASE("a charger with contacts charges a robot that touches them with its front, and looks that way",
          "[sim][battery]") {
  const auto is_charged = [](const Pose2& contacts) {
    Room room({}, {{"dock", contacts, 0.03, true}});  // The Scout stands at the origin, its front at 0.205 m.
    room.run(1.0);
    return battery_in(room.world, room.robot)->charging;
  };
  CHECK(is_charged({0.225, 0.0, 0.0}));
  CHECK(is_charged({0.21, -0.02, 9 * kDegree}));
  CHECK_FALSE(is_charged({0.25, 0.0, 0.0}));
  CHECK_FALSE(is_charged({0.21, 0.04, 0.0}));
  CHECK_FALSE(is_charged({0.21, 0.0, 11 * kDegree}));
  CHECK_FALSE(is_charged({-0.21, 0.0, 0.0}));
}

TEST_CASE("a touch of the contacts of a charger is no contact unless it is fast, one elsewhere is",
          "[sim][battery]") {
  const auto touches = [](double speed, const std::vector<Charger>& chargers) {
    WorldModel model = test_room();
    model.obstacles.push_back({.name = "post", .shape = Circle{{0.5, 0.0}, 0.1}, .height = 1.0});
    model.chargers = chargers;
    World world(std::move(model), {.seed = 1, .realism = Realism::ideal});
    const RobotId robot = world.add_robot("Scout", scout(), {}).value();
    REQUIRE(world.set_velocity_command(robot, speed, 0.0).ok());
    std::size_t contacts = 0;
    for (int tick = 0; tick < 800; ++tick) {
      world.step();
      contacts += world.contacts().size();
    }
    return contacts;
  };
  CHECK(touches(0.05, {{"dock", {0.39, 0.0, 0.0}, 0.03, true}}) == 0);
  CHECK(touches(0.3, {{"dock", {0.39, 0.0, 0.0}, 0.03, true}}) == 1);
  CHECK(touches(0.05, {{"dock", {0.39, 0.0, 180 * kDegree}, 0.03, true}}) == 1);
  CHECK(touches(0.05, {{"dock", {0.39, 0.0, 0.0}, 0.3, false}}) == 1);
}

TEST_CASE("a robot without a battery has none to read, charge or drain", "[sim][battery]") {
  World world = Room::make({.drains = {{"Scout", seconds(1), 0.0}}}, {});
  const RobotId robot = world.add_robot("Scout", scout(), {}).value();
  CHECK_FALSE(battery_in(world, robot));
  CHECK(set_charge(world, robot, 0.5).error().code == Code::not_found);
  std::string said;
  for (int tick = 0; tick < 200; ++tick) {
    world.step();
    for (const std::string& note : world.happened()) said += note;
  }
  CHECK_THAT(said, Catch::Contains("not at all: this robot has no battery"));
}
