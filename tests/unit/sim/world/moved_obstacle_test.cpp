// SPDX-License-Identifier: GPL-3.0-or-later
// Obstacles that are put in, moved and taken out while the world runs.
#include <catch2/catch.hpp>

#include "orca/base/hash.hpp"
#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using orca::Pose2;
using namespace orca::sim::test;

namespace {

const Shape kCrate = Box{{}, {0.3, 0.2}};

World room() { return World(test_room(), {.seed = 1, .realism = Realism::ideal}); }

double range(const World& world, double height = 0.3) {
  return world.caster().cast({{-2, -2}, {1, 0}, 20.0, height}).range;
}

std::vector<std::string> contacts_of(World& world, int ticks) {
  std::vector<std::string> told;
  for (int i = 0; i < ticks; ++i) {
    world.step();
    for (const ContactEvent& e : world.contacts()) told.push_back(e.other);
  }
  return told;
}

}  // namespace

TEST_CASE("rays see an obstacle come, move, turn and go", "[sim][obstacle]") {
  World world = room();
  CHECK(range(world) == Approx(7.0));
  const auto id = world.add_obstacle("crate", kCrate, 0.8, {0, -2, 0});
  REQUIRE(id);
  CHECK(range(world) == Approx(1.7));
  CHECK(range(world, 0.9) == Approx(7.0));
  REQUIRE(world.move_obstacle(*id, {1, -2, 0.5 * std::numbers::pi}));
  CHECK(range(world) == Approx(2.8));
  REQUIRE(world.remove_obstacle(*id));
  CHECK(range(world) == Approx(7.0));
}

TEST_CASE("a robot runs into an obstacle put in its way, and drives on when it is removed",
          "[sim][obstacle]") {
  World world = room();
  const RobotId robot = *world.add_robot("dewey", scout(), {-2, -2, 0});
  const auto crate = world.add_obstacle("crate", kCrate, 0.8, {0, -2, 0});
  REQUIRE(crate);
  REQUIRE(world.set_velocity_command(robot, 0.5, 0.0));
  CHECK(contacts_of(world, 500) == std::vector<std::string>{"crate"});
  CHECK(world.pose(robot).x == Approx(-0.505).margin(0.01));
  REQUIRE(world.remove_obstacle(*crate));
  CHECK(contacts_of(world, 300).empty());
  CHECK(world.pose(robot).x > 0.5);
}

TEST_CASE("an obstacle of any shape that is moved into a robot's way is met there", "[sim][obstacle]") {
  for (const Shape& shape :
       {kCrate, Shape{Circle{{}, 0.3}}, Shape{outline_of({{-0.3, -0.4}, {0.3, -0.4}, {0, 0.6}})}}) {
    World world = room();
    const RobotId robot = *world.add_robot("dewey", scout(), {-2, -2, 0});
    const auto id = world.add_obstacle("thing", shape, 0.8, {0, 2, 0});
    REQUIRE(id);
    REQUIRE(world.move_obstacle(*id, {0, -2, 0.0}));
    REQUIRE(world.set_velocity_command(robot, 0.5, 0.0));
    CHECK(contacts_of(world, 500) == std::vector<std::string>{"thing"});
    CHECK(world.pose(robot).x < -0.3);
  }
}

TEST_CASE("no obstacle can be put onto a robot, unless it is flat enough to lie under it",
          "[sim][obstacle]") {
  World world = room();
  REQUIRE(world.add_robot("dewey", scout(), {0, 0, 0}));
  const auto refused = world.add_obstacle("crate", kCrate, 0.8, {0.4, 0, 0});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == orca::Code::failed_precondition);
  CHECK(refused.error().message ==
        "obstacle 'crate' cannot stand at (0.40, 0.00) m: robot 'dewey' is there; choose a free place");
  CHECK(world.add_obstacle("mat", kCrate, 0.02, {0.4, 0, 0}));
  const auto crate = world.add_obstacle("crate", kCrate, 0.8, {0.6, 0, 0});
  REQUIRE(crate);
  CHECK_FALSE(world.move_obstacle(*crate, {0.2, 0.1, 0}));
  CHECK(range(world) == Approx(7.0));
}

TEST_CASE("impossible obstacles are refused with the reason", "[sim][obstacle]") {
  World world = room();
  const auto error = [&](const std::string& name, const Shape& shape, double height, Pose2 at) {
    const auto added = world.add_obstacle(name, shape, height, at);
    return added ? "" : added.error().message;
  };
  CHECK_THAT(error("", kCrate, 1.0, {}), Catch::Contains("needs a name"));
  CHECK_THAT(error("a", kCrate, 0.0, {}), Catch::Contains("height"));
  CHECK_THAT(error("a", Circle{{}, -1.0}, 1.0, {}), Catch::Contains("no area"));
  CHECK_THAT(error("a", Box{{}, {0.1, 0.0}}, 1.0, {}), Catch::Contains("no area"));
  CHECK_THAT(error("a", Outline{}, 1.0, {}), Catch::Contains("no area"));
  CHECK_THAT(error("a", kCrate, 1.0, {std::nan(""), 0, 0}), Catch::Contains("not finite"));
  const double endless = std::numeric_limits<double>::infinity();
  CHECK_THAT(error("a", Circle{{1e20, 0}, 1.0}, 1.0, {}), Catch::Contains("beyond 100 km"));
  CHECK_THAT(error("a", Circle{{}, endless}, 1.0, {}), Catch::Contains("not finite"));
  CHECK_THAT(error("a", Box{{}, {1.0, endless}}, 1.0, {}), Catch::Contains("not finite"));
  CHECK_THAT(error("a", Outline{{{{0, 0}, {1, 0}}, {{1, 0}, {std::nan(""), 1}}}}, 1.0, {}),
             Catch::Contains("not finite"));
  CHECK(error("a", kCrate, 1.0, {}).empty());
  CHECK_THAT(error("a", kCrate, 1.0, {2, 2, 0}), Catch::Contains("already"));
}

TEST_CASE("an obstacle that was removed, or never existed, cannot be moved or removed", "[sim][obstacle]") {
  World world = room();
  const ObstacleId id = *world.add_obstacle("crate", kCrate, 0.8, {0, -2, 0});
  REQUIRE(world.remove_obstacle(id));
  CHECK(world.move_obstacle(id, {}).error().code == orca::Code::not_found);
  CHECK(world.remove_obstacle(id).error().code == orca::Code::not_found);
  CHECK_FALSE(world.move_obstacle(ObstacleId{77}, {}));
  CHECK(world.add_obstacle("crate", kCrate, 0.8, {0, -2, 0}));
}

TEST_CASE("no robot is set down on an obstacle that was put in", "[sim][obstacle]") {
  World world = room();
  REQUIRE(world.add_obstacle("crate", kCrate, 0.8, {0, -2, 0}));
  const auto added = world.add_robot("dewey", scout(), {0.2, -2, 0});
  REQUIRE_FALSE(added);
  CHECK_THAT(added.error().message, Catch::Contains("it would stand in 'crate'"));
}

TEST_CASE("two worlds in which the same obstacles are added, moved and removed are bit-identical",
          "[sim][obstacle]") {
  const auto hash = [] {
    World world = room();
    const RobotId robot = *world.add_robot("dewey", scout(), {-2, -2, 0});
    REQUIRE(world.set_velocity_command(robot, 0.5, 0.1));
    orca::Fnv1a trace;
    std::optional<ObstacleId> last;
    for (int i = 0; i < 2000; ++i) {
      if (i % 100 == 0) {
        if (last) REQUIRE(world.remove_obstacle(*last));
        last.reset();
        const auto id = world.add_obstacle("crate", kCrate, 0.8, {0.01 * (i % 300), -1.7, 0.001 * i});
        if (id) last = *id;
      }
      world.step();
      trace.add_u64(world.state_hash());
    }
    return trace.value();
  };
  CHECK(hash() == hash());
}
