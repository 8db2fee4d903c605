// SPDX-License-Identifier: GPL-3.0-or-later
// What happens in a world at given times.
#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "orca/sim/world_file.hpp"
#include "scout.hpp"
#include "shipped.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::sim;
using namespace orca::sim::test;
using Catch::Contains;
using orca::test::TempFolder;
using std::chrono::seconds;

namespace {

constexpr double kAt = 1.0;  // [s] Time at which things happen.

Visitor crate() {
  return {.name = "crate",
          .shape = Box{{}, {0.5, 0.5}},
          .height = 1.0,
          .X_WO = {0.0, 3.0, 0.0},
          .comes = seconds(1)};
}

World world_with(Events events) {
  WorldModel model = test_room();
  model.events = std::move(events);
  return World(std::move(model), {.seed = 1, .realism = Realism::ideal});
}

// Runs to that time [s] and returns what happened.
std::vector<std::string> run_to(World& world, double time) {
  std::vector<std::string> happened;
  while (to_seconds(world.time() - TimePoint{}) < time - 1e-6) {
    world.step();
    happened.insert(happened.end(), world.happened().begin(), world.happened().end());
  }
  return happened;
}

// Distance to what stands on the line from the middle of the room to the crate's place [m].
double look(const World& world) {
  return world.caster()
      .cast({.origin = {0.0, 0.0}, .direction = {0.0, 1.0}, .max_range = 10.0, .sensor_height = 0.5})
      .range;
}

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("an obstacle comes, is moved and goes at its times", "[sim][event]") {
  Visitor visitor = crate();
  visitor.goes = seconds(3);
  World world = world_with({.visitors = {visitor}, .moves = {{"crate", seconds(2), {0.0, 4.0, 0.0}}}});
  CHECK(run_to(world, kAt).empty());
  CHECK(look(world) == Approx(5.0));
  CHECK(run_to(world, 1.5) == Words{"crate comes"});
  CHECK(look(world) == Approx(2.5));
  CHECK(run_to(world, 2.5) == Words{"crate is moved"});
  CHECK(look(world) == Approx(3.5));
  CHECK(run_to(world, 3.5) == Words{"crate goes"});
  CHECK(look(world) == Approx(5.0));
}

TEST_CASE("what a robot is in the way of happens when it has gone, and is said once before", "[sim][event]") {
  World world = world_with({.visitors = {crate()}});
  const RobotId scout = world.add_robot("scout", sim::test::scout(), {0.0, 3.0, 0.0}).value();
  const Words happened = run_to(world, 2.0);
  REQUIRE(happened.size() == 1);
  CHECK_THAT(happened[0], Contains("crate comes later: ") && Contains("robot 'scout' is there"));
  REQUIRE(world.set_velocity_command(scout, 0.5, 0.0).ok());
  CHECK(run_to(world, 8.0) == Words{"crate comes"});
}

TEST_CASE("a robot that is carried off stands elsewhere, and its odometry does not notice", "[sim][event]") {
  World world = world_with({.kidnaps = {{"scout", seconds(1), {-2.0, 2.0, 1.0}}}});
  const RobotId robot = world.add_robot("scout", sim::test::scout(), {0.0, 0.0, 0.0}).value();
  CHECK(run_to(world, 1.2) == Words{"scout is kidnapped"});
  CHECK(world.pose(robot).x == -2.0);
  CHECK(world.pose(robot).y == 2.0);
  CHECK(world.pose(robot).yaw == 1.0);
  std::optional<OdometryReading> odometry;
  for (int i = 0; i < 100 && !odometry; ++i) {
    world.step();
    odometry = world.odometry(robot);
  }
  REQUIRE(odometry);
  CHECK(odometry->pose.x == 0.0);
  CHECK(world.contacts().empty());
}

TEST_CASE("a robot that drives is at rest where it is put down, and drives on by its command",
          "[sim][event]") {
  World world = world_with({.kidnaps = {{"scout", seconds(3), {-4.0, 0.0, 0.0}}}});
  const RobotId robot = world.add_robot("scout", sim::test::scout(), {0.0, -2.0, 0.0}).value();
  REQUIRE(world.set_velocity_command(robot, 0.4, 0.0).ok());
  (void)run_to(world, 3.0);
  CHECK(world.velocity(robot).forward == Approx(0.4));
  (void)run_to(world, 3.02);
  CHECK(world.velocity(robot).forward < 0.2);
  CHECK(world.pose(robot).x == Approx(-4.0).margin(0.01));
  (void)run_to(world, 5.0);
  CHECK(world.velocity(robot).forward == Approx(0.4));
}

TEST_CASE("nobody is put into a wall, and a robot that is not there is said once", "[sim][event]") {
  World world = world_with(
      {.kidnaps = {{"scout", seconds(1), {5.0, 0.0, 0.0}}, {"dewey", seconds(1), {0.0, 0.0, 0.0}}}});
  const RobotId robot = world.add_robot("scout", sim::test::scout(), {0.0, 0.0, 0.0}).value();
  const Words happened = run_to(world, 2.0);
  REQUIRE(happened.size() == 2);
  CHECK_THAT(happened[0], Contains("scout is kidnapped later: ") && Contains("obstacle 'east'"));
  CHECK_THAT(happened[1], Contains("dewey is kidnapped not at all: there is no robot \"dewey\""));
  CHECK(world.pose(robot).x == 0.0);
}

namespace {

// Two rooms of 4 m by 4 m with a door between them, and one without a door.
constexpr const char* kThreeRooms = R"(<world name="rooms" version="1">
  <room from="0 0" to="4 4"><door side="east" at="2 m" width="1 m"/></room>
  <wall from="4 0" to="8 0"/><wall from="8 0" to="8 4"/><wall from="4 4" to="8 4"/>
  <room from="8 0" to="12 4"/>
  <kidnap robot="scout" at="1 s" latest="3 s" away="2 m"/>
</world>)";

struct Carried {
  double at = 0.0;  // [s]
  Pose2 to;
};

// Where a robot in the first room is carried, and when.
Carried carried(std::uint64_t seed) {
  const TempFolder folder;
  xml::Diagnostics diagnostics;
  const auto model = read_world(folder.write("rooms.xml", kThreeRooms), {}, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(model);
  World world(*model, {.seed = seed, .realism = Realism::ideal});
  const RobotId robot = world.add_robot("scout", sim::test::scout(), {1.0, 1.0, 0.0}).value();
  while (world.happened().empty()) world.step();
  CHECK(world.happened() == Words{"scout is kidnapped"});
  CHECK(world.contacts().empty());
  return {to_seconds(world.time() - TimePoint{}), world.pose(robot)};
}

}  // namespace

TEST_CASE("a robot is carried to a drawn place to which there is a way, at a drawn time", "[sim][event]") {
  int in_next_room = 0;
  double first = 9.0;
  double last = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Carried one = carried(seed);
    INFO("seed " << seed << ": " << one.to.x << ' ' << one.to.y);
    CHECK(norm(one.to.position() - Vec2{1.0, 1.0}) >= 2.0);
    CHECK(one.to.x < 8.0);
    CHECK(one.at >= 1.0);
    CHECK(one.at <= 3.02);
    in_next_room += one.to.x > 4.0 ? 1 : 0;
    first = std::min(first, one.at);
    last = std::max(last, one.at);
  }
  // The next room has about two thirds of the places that are far enough away.
  CHECK(in_next_room > 18);
  CHECK(in_next_room < 36);
  CHECK(last - first > 1.5);
  CHECK(carried(7).to == carried(7).to);
}

TEST_CASE("a robot is not carried off where no place is far enough away", "[sim][event]") {
  World world = world_with({.kidnaps = {{.robot = "scout", .at = seconds(1), .away = 50.0}}});
  REQUIRE(world.add_robot("scout", sim::test::scout(), {0.0, 0.0, 0.0}));
  const Words happened = run_to(world, 1.2);
  REQUIRE(happened.size() == 1);
  CHECK_THAT(happened[0], Contains("scout is kidnapped not at all: no free place was found"));
}

TEST_CASE("sensors that are out read nothing, and others go on", "[sim][event]") {
  World world = world_with({.outages = {{"scout", SensorKind::sonar, seconds(1), seconds(2)}}});
  const RobotId robot = world.add_robot("scout", sim::test::scout(), {0.0, 0.0, 0.0}).value();
  const auto count = [&](double until) {
    std::pair<int, int> read;
    while (to_seconds(world.time() - TimePoint{}) < until - 1e-6) {
      world.step();
      read.first += world.sonar(robot) ? 1 : 0;
      read.second += world.odometry(robot) ? 1 : 0;
    }
    return read;
  };
  const auto before = count(0.99);
  CHECK(before.first > 0);
  const auto out = count(1.99);
  CHECK(out.first == 0);
  CHECK(out.second > 0);
  CHECK(count(2.99).first > 0);
}

TEST_CASE("of several sensors of a kind one can be out alone", "[sim][event]") {
  World world = world_with({.outages = {{"courier", SensorKind::laser, seconds(1), {}, "low"},
                                        {"courier", SensorKind::laser, seconds(1), {}, "lower"}}});
  const RobotModel courier = shipped("courier");
  const RobotId robot = world.add_robot("courier", courier, {0.0, 0.0, 0.0}).value();
  REQUIRE(courier.lasers.at(1).name == "low");
  std::pair<int, int> read;
  std::vector<std::string> notes;
  while (to_seconds(world.time() - TimePoint{}) < 1.99 - 1e-6) {
    world.step();
    const bool later = to_seconds(world.time() - TimePoint{}) > 1.0;
    read.first += later && world.laser(robot, 0) ? 1 : 0;
    read.second += later && world.laser(robot, 1) ? 1 : 0;
    for (const std::string& note : world.happened()) notes.push_back(note);
  }
  CHECK(read.first > 0);
  CHECK(read.second == 0);
  CHECK(notes == std::vector<std::string>{
                     "laser \"low\" of courier fails",
                     "laser \"lower\" of courier fails not at all: courier has no laser of that name"});
}

TEST_CASE("events of a file happen, and two runs of them agree bit for bit", "[sim][event]") {
  xml::Diagnostics diagnostics;
  const auto model = read_world(ORCA_SOURCE_DIR "/sim/worlds/surprises.xml", {}, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(model);
  const auto run = [&] {
    World world(*model, {.seed = 1, .realism = Realism::nominal});
    REQUIRE(world.add_robot("Pioneer", sim::test::scout(), model->place("start")->pose));
    return std::pair(run_to(world, 45.0), world.state_hash());
  };
  const auto first = run();
  CHECK(first.first == Words{"trolley comes", "trolley is moved", "Pioneer is kidnapped",
                             "laser of Pioneer fails", "laser of Pioneer works again", "trolley goes"});
  CHECK(run() == first);
}
