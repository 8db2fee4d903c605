// SPDX-License-Identifier: GPL-3.0-or-later
// A simulated world as objects: what is seen of it from outside, and how it is changed.
#include "world_objects.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "scout.hpp"
#include "shared_world.hpp"

using namespace orca;
using namespace orca::sim;
using namespace orca::sim::test;
using Catch::Contains;

namespace {

// A Scout in the middle of the test room, whose post has a place beside it.
struct Room {
  Room() : world(model(), {.seed = 1, .realism = Realism::ideal}) {
    dewey = world.add_robot("Dewey", scout(), {}).value();
  }
  static WorldModel model() {
    WorldModel model = test_room();
    model.places.push_back({"post", {2.0, 0.0, 1.0}});
    model.walkers.push_back({.name = "anna", .track = {{-4, 3}, {-4, -3}}, .start = Duration{0}});
    model.items.push_back({"can", 0.05, 0.2, {-2.0, -2.0, 0.0}});
    return model;
  }
  Result<std::string> change(const idl::WorldChange& change) { return carry_out(change, world); }
  [[nodiscard]] idl::WorldScene scene() const {
    idl::WorldScene scene;
    fill(scene, world);
    return scene;
  }
  World world;
  RobotId dewey{};
};

idl::WorldChange change_of(idl::WorldChangeKind kind, const std::string& name, double x = 0.0,
                           double y = 0.0) {
  idl::WorldChange change;
  change.kind(kind);
  change.name(name);
  change.x(x);
  change.y(y);
  return change;
}

idl::WorldChange box(double x, double y) {
  idl::WorldChange change = change_of(idl::PUT_OBSTACLE, "box", x, y);
  change.length(0.4);
  change.width(0.6);
  return change;
}

idl::WorldChange sensor(idl::WorldChangeKind kind, const std::string& name) {
  idl::WorldChange change = change_of(kind, "Dewey");
  change.sensor(name);
  return change;
}

// Distance to what stands on the x axis to the left of the robot [m].
double look_left(const World& world) {
  return world.caster()
      .cast({.origin = {-0.5, 0.0}, .direction = {-1.0, 0.0}, .max_range = 10.0, .sensor_height = 0.5})
      .range;
}

}  // namespace

TEST_CASE("the plan of a world holds its walls and places, and nothing that moves", "[sim][world_objects]") {
  idl::WorldPlan plan;
  fill(plan, Room::model());
  CHECK(plan.name() == "test room");
  CHECK(plan.walls().size() == 4 * 4 + 16);  // Four boxes and a round post.
  REQUIRE(plan.places().size() == 1);
  CHECK(plan.places()[0].name() == "post");
  CHECK(plan.places()[0].x() == 2.0);
  CHECK(plan.places()[0].yaw() == 1.0);
}

TEST_CASE("a scene shows robots, people and what stands there where they truly are", "[sim][world_objects]") {
  Room room;
  REQUIRE(room.world.set_velocity_command(room.dewey, 0.5, 0.0));
  for (int tick = 0; tick < 100; ++tick) room.world.step();
  const idl::WorldScene scene = room.scene();
  REQUIRE(scene.robots().size() == 1);
  CHECK(scene.robots()[0].name() == "Dewey");
  CHECK(scene.robots()[0].x() == room.world.pose(room.dewey).x);
  CHECK(scene.robots()[0].x() > 0.1);
  CHECK(scene.robots()[0].forward() == Approx(0.5).margin(0.05));
  CHECK(scene.robots()[0].radius() == 0.19);
  CHECK(scene.robots()[0].outline().empty());  // It is round.
  REQUIRE(scene.people().size() == 1);
  CHECK(scene.people()[0].name() == "anna");
  CHECK(scene.people()[0].y() == Approx(2.0).margin(0.02));
  CHECK(scene.people()[0].speed() == Approx(1.0));
  REQUIRE(scene.obstacles().size() == 1);
  CHECK(scene.obstacles()[0].name() == "can");
  CHECK_FALSE(scene.obstacles()[0].movable());
}

TEST_CASE("an obstacle is put, moved and taken away, and sensors see it at once", "[sim][world_objects]") {
  Room room;
  REQUIRE(look_left(room.world) == Approx(4.5));
  CHECK(room.change(box(-2.0, 0.0)).value() == "box comes to (-2, 0) m");
  CHECK(look_left(room.world) == Approx(1.3));
  REQUIRE(room.scene().obstacles().size() == 2);
  CHECK(room.scene().obstacles()[0].name() == "box");
  CHECK(room.scene().obstacles()[0].outline().size() == 4);
  CHECK(room.scene().obstacles()[0].movable());
  CHECK(room.change(change_of(idl::MOVE_OBSTACLE, "box", -3.0, 0.0)).value() == "box is moved to (-3, 0) m");
  CHECK(look_left(room.world) == Approx(2.3));
  CHECK(room.change(change_of(idl::TAKE_OBSTACLE, "box")).value() == "box goes");
  CHECK(look_left(room.world) == Approx(4.5));
  CHECK(room.scene().obstacles().size() == 1);
}

TEST_CASE("an obstacle without a width is a cylinder as wide as it is long", "[sim][world_objects]") {
  Room room;
  idl::WorldChange post = box(-2.0, 0.0);
  post.width(0.0);
  REQUIRE(room.change(post));
  CHECK(look_left(room.world) == Approx(1.3));
  CHECK(room.scene().obstacles()[0].radius() == 0.2);
}

TEST_CASE("a change that cannot be is refused with the reason, and changes nothing", "[sim][world_objects]") {
  Room room;
  REQUIRE(room.change(box(-2.0, 0.0)));
  const std::uint64_t before = room.world.state_hash();
  const auto refused = [&](const idl::WorldChange& change, Code code, const std::string& text) {
    const Result<std::string> answer = room.change(change);
    REQUIRE_FALSE(answer);
    CHECK(answer.error().code == code);
    CHECK_THAT(answer.error().message, Contains(text));
  };
  refused(box(1.0, 1.0), Code::already_exists, "there is a 'box' already");
  idl::WorldChange other = box(0.1, 0.0);
  other.name("other");
  refused(other, Code::failed_precondition, "robot 'Dewey' is there");
  other.x(std::nan(""));
  refused(other, Code::invalid_argument, "not finite");
  other.length(0.0);
  refused(other, Code::invalid_argument, "no area");
  refused(change_of(idl::MOVE_OBSTACLE, "bax"), Code::not_found, "did you mean \"box\"?");
  refused(change_of(idl::TAKE_OBSTACLE, "post"), Code::failed_precondition, "\"post\" stands fast");
  refused(change_of(idl::TAKE_OBSTACLE, "can"), Code::failed_precondition, "only a robot moves it");
  refused(change_of(idl::CARRY_ROBOT, "Dewie", 1.0), Code::not_found, "there are: Dewey");
  refused(change_of(idl::CARRY_ROBOT, "Dewey", 3.0), Code::failed_precondition, "obstacle 'post'");
  refused(sensor(idl::SILENCE_SENSOR, "radar"), Code::invalid_argument, "kinds: sonar, laser");
  refused(sensor(idl::SILENCE_SENSOR, "laser"), Code::not_found, "Dewey has no laser");
  refused(sensor(idl::RESTORE_SENSOR, "sonar"), Code::failed_precondition, "sonar of Dewey is not silent");
  CHECK(room.world.state_hash() == before);
}

TEST_CASE("a door is opened and shut, the scene shows its leaf, and no change moves that",
          "[sim][world_objects]") {
  WorldModel model = test_room();
  model.doors = {{.name = "gate",
                  .shut = {{-0.5, 3.0}, {0.5, 3.0}},
                  .swing = std::numbers::pi / 2.0,
                  .thickness = 0.04,
                  .height = 2.0}};
  World world(std::move(model), {.seed = 1, .realism = Realism::ideal});
  world.step();
  const auto scene = [&] {
    idl::WorldScene all;
    fill(all, world);
    return all;
  };
  REQUIRE(scene().doors().size() == 1);
  CHECK(scene().doors()[0].name() == "gate");
  CHECK_FALSE(scene().doors()[0].open());
  REQUIRE(scene().obstacles().size() == 1);
  CHECK_FALSE(scene().obstacles()[0].movable());
  CHECK(carry_out(change_of(idl::OPEN_DOOR, "gate"), world).value() == "gate opens");
  CHECK(scene().doors()[0].open());
  for (int tick = 0; tick < 160; ++tick) world.step();
  CHECK(scene().doors()[0].leaf().b().y() == Approx(4.0));
  const auto message = [&](idl::WorldChangeKind kind, const std::string& name) {
    const Result<std::string> changed = carry_out(change_of(kind, name), world);
    return changed ? *changed : changed.error().message;
  };
  CHECK_THAT(message(idl::OPEN_DOOR, "gate"), Contains("gate is open already"));
  CHECK_THAT(message(idl::SHUT_DOOR, "gat"), Contains("there is no door \"gat\"; there are: gate"));
  CHECK_THAT(message(idl::TAKE_OBSTACLE, "gate"), Contains("it is only opened and shut"));
  CHECK_THAT(message(idl::MOVE_OBSTACLE, "gate"), Contains("it is only opened and shut"));
  CHECK(message(idl::SHUT_DOOR, "gate") == "gate shuts");
}

TEST_CASE("a robot that is carried off stands elsewhere, and its odometry notices nothing",
          "[sim][world_objects]") {
  Room room;
  idl::WorldChange carry = change_of(idl::CARRY_ROBOT, "Dewey", -3.0, -1.0);
  carry.yaw(2.0);
  CHECK(room.change(carry).value() == "Dewey is carried to (-3, -1) m");
  for (int tick = 0; tick < 5; ++tick) room.world.step();
  CHECK(room.scene().robots()[0].x() == Approx(-3.0));
  CHECK(room.scene().robots()[0].yaw() == Approx(2.0));
  REQUIRE(room.world.odometry(room.dewey));
  CHECK(room.world.odometry(room.dewey)->pose.x == Approx(0.0).margin(1e-6));
}

TEST_CASE("a sensor that is silenced reads nothing until it is restored, and the scene names it",
          "[sim][world_objects]") {
  Room room;
  const auto rounds = [&] {
    int count = 0;
    for (int tick = 0; tick < 100; ++tick) {
      room.world.step();
      count += room.world.sonar(room.dewey) ? 1 : 0;
    }
    return count;
  };
  REQUIRE(rounds() > 0);
  CHECK(room.change(sensor(idl::SILENCE_SENSOR, "sonar")).value() == "sonar of Dewey fails");
  CHECK(room.scene().robots()[0].silent() == std::vector<std::string>{"sonar"});
  CHECK(rounds() == 0);
  CHECK_FALSE(room.change(sensor(idl::SILENCE_SENSOR, "sonar")));
  CHECK(room.change(sensor(idl::RESTORE_SENSOR, "sonar")).value() == "sonar of Dewey works again");
  CHECK(room.scene().robots()[0].silent().empty());
  CHECK(rounds() > 0);
}

TEST_CASE("one device of several is silenced and restored alone, but not restored alone from all",
          "[sim][world_objects]") {
  RobotModel twin = scout();
  twin.sonars.push_back(twin.sonars[0]);
  twin.sonars[1].name = "rear";
  World world(test_room(), {.seed = 1, .realism = Realism::ideal});
  const RobotId robot = world.add_robot("Dewey", twin, {}).value();
  idl::WorldChange rear = sensor(idl::SILENCE_SENSOR, "sonar");
  rear.device("rear");
  REQUIRE(carry_out(rear, world));
  CHECK(silent_in(world, robot) == std::vector<std::string>{"sonar rear"});
  rear.kind(idl::RESTORE_SENSOR);
  REQUIRE(carry_out(rear, world));
  CHECK(silent_in(world, robot).empty());
  REQUIRE(carry_out(sensor(idl::SILENCE_SENSOR, "sonar"), world));
  const Result<std::string> alone = carry_out(rear, world);
  REQUIRE_FALSE(alone);
  CHECK_THAT(alone.error().message, Contains("restore them together"));
  REQUIRE(carry_out(sensor(idl::RESTORE_SENSOR, "sonar"), world));
  CHECK(silent_in(world, robot).empty());
}

TEST_CASE("a shared world keeps what has happened for five seconds, contacts with their place",
          "[sim][world_objects]") {
  SharedWorld shared(World(test_room(), {.seed = 1, .realism = Realism::ideal}), "", TimePoint{});
  const RobotId robot = shared.add_robot("Dewey", scout(), {2.0, 0.0, 0.0}, kTruthPeriod).value();
  const auto at = [](double seconds) { return TimePoint{} + from_seconds(seconds); };
  REQUIRE(shared.command(robot, {.velocity = {.forward = 0.5}}, at(0.0)));
  for (int i = 1; i <= 30; ++i) (void)shared.advance(robot, at(0.1 * i));
  const auto events = shared.events();
  REQUIRE(events.size() == 1);
  CHECK(events[0].text == "Dewey touches post");
  REQUIRE(events[0].place);
  CHECK(events[0].place->x == Approx(3.0 - 0.3 - 0.205).margin(0.02));
  for (int i = 31; i <= 90; ++i) (void)shared.advance(robot, at(0.1 * i));
  CHECK(shared.events().empty());
}
