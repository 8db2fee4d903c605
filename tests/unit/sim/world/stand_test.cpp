// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/sim/stand.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "motion/physics.hpp"
#include "orca/base/random.hpp"
#include "orca/sim/robot_file.hpp"
#include "orca/sim/world.hpp"
#include "orca/sim/world_file.hpp"

using namespace orca;
using namespace orca::sim;

namespace {

RobotModel shipped(const std::string& name) {
  xml::Diagnostics wrong;
  const auto model = read_robot(ORCA_SOURCE_DIR "/sim/robots/" + name + ".urdf", wrong);
  REQUIRE(model);
  return *model;
}

// A base of 0.4 m, 0.3 m high, and a mast of 0.1 m above it up to 1.2 m.
RobotModel masted() {
  RobotModel robot = shipped("nomad_scout");
  robot.parts = {{Part::Cylinder{0.2, 0.3}, {.z = 0.15}}, {Part::Block{0.1, 0.1, 0.9}, {.z = 0.75}}};
  robot.footprint = footprint_of(robot.parts);
  std::tie(robot.bottom, robot.top) = height_range_of(robot.parts);
  return robot;
}

Obstacle block(const std::string& name, const Pose2& pose, Vec2 half, double bottom, double height) {
  return {.name = name, .shape = Box{pose, half}, .height = height, .bottom = bottom};
}

}  // namespace

TEST_CASE("what a robot stands in is found with the shortest way out", "[sim][stand]") {
  WorldModel world;
  world.obstacles = {block("wall", {1.0, 0.0, 0.0}, {0.1, 3.0}, 0.0, 2.0)};
  world.items = {{"can", 0.05, 0.1, {-0.1, 0.15, 0.0}}};
  world.doors = {{.name = "leaf", .shut = {{0.3, -1.0}, {0.3, -0.15}}, .thickness = 0.04, .height = 2.0}};
  const auto holds = what_holds(masted(), {0.75, 0.0, 0.0}, world);
  REQUIRE(holds.size() == 1);
  CHECK(holds[0].name == "wall");
  CHECK(holds[0].way == Approx(0.05).margin(0.0015));
  REQUIRE(holds[0].clear);
  CHECK(holds[0].clear->x == Approx(0.7).margin(0.0015));
  CHECK(holds[0].clear->y == Approx(0.0).margin(1e-9));

  SECTION("and all of it, obstacles, leaves and items") {
    world.obstacles[0].shape = Box{{0.2, 0.0, 0.0}, {0.1, 3.0}};
    std::vector<std::string> names;
    for (const StandsIn& there : what_holds(masted(), {0.15, -0.05, 0.0}, world)) names.push_back(there.name);
    CHECK(names == std::vector<std::string>{"wall", "leaf"});
    names.clear();
    for (const StandsIn& there : what_holds(masted(), {0.05, 0.05, 0.0}, world)) names.push_back(there.name);
    CHECK(names == std::vector<std::string>{"wall", "can"});
  }
  SECTION("and an open leaf is where it opens to") {
    world.doors[0].open = true;
    world.doors[0].swing = -1.5707963;
    CHECK(what_holds(masted(), {0.3, -0.4, 0.0}, world).empty());
    CHECK(what_holds(masted(), {-0.3, -1.1, 0.0}, world).empty());
    CHECK(what_holds(masted(), {0.75, -1.1, 0.0}, world).size() == 2);
  }
}

TEST_CASE("a robot may stand under a table top, but not with its mast in it", "[sim][stand]") {
  WorldModel world;
  const RobotModel robot = masted();
  for (const bool outline : {false, true}) {
    CAPTURE(outline);
    world.obstacles = {block("table", {0.0, 0.0, 0.0}, {0.6, 0.6}, 0.7, 0.75)};
    if (outline) world.obstacles[0].shape = outline_of({{-0.6, -0.6}, {0.6, -0.6}, {0.6, 0.6}, {-0.6, 0.6}});
    CHECK(what_holds(robot, {-0.7, 0.0, 0.0}, world).empty());
    // The mast is in the middle of the top, and near none of its edges.
    const auto holds = what_holds(robot, {0.3, 0.0, 0.0}, world);
    REQUIRE(holds.size() == 1);
    CHECK(holds[0].way == Approx(0.35).margin(0.0015));
    world.obstacles[0].bottom = 1.2;
    world.obstacles[0].height = 1.3;
    CHECK(what_holds(robot, {0.0, 0.0, 0.0}, world).empty());
  }
}

TEST_CASE("a robot in the middle of a mesh or a polygon stands in it", "[sim][stand]") {
  WorldModel world;
  Mesh pyramid;
  const Vec3 top{0.0, 0.0, 4.0};
  const std::array<Vec3, 4> foot{Vec3{-4, -4, 0}, Vec3{4, -4, 0}, Vec3{4, 4, 0}, Vec3{-4, 4, 0}};
  for (std::size_t i = 0; i < 4; ++i) pyramid.triangles.push_back({foot[i], foot[(i + 1) % 4], top});
  pyramid.triangles.push_back({foot[0], foot[2], foot[1]});
  pyramid.triangles.push_back({foot[0], foot[3], foot[2]});
  world.obstacles = {mesh_obstacle("pyramid", pyramid)};
  const RobotModel robot = masted();
  CHECK(what_holds(robot, {0.0, 0.0, 0.0}, world).size() == 1);
  // At 0.3 m, the height of the base, the pyramid reaches to x = 3.7 m, and at the foot to 4 m.
  CHECK(what_holds(robot, {4.21, 0.0, 0.0}, world).empty());
  const auto holds = what_holds(robot, {4.0, 0.0, 0.0}, world);
  REQUIRE(holds.size() == 1);
  CHECK(holds[0].way == Approx(0.2).margin(0.0015));
}

TEST_CASE("the open paddles of a gripper count", "[sim][stand]") {
  WorldModel world;
  const RobotModel robot = shipped("pioneer_2dx_gripper");
  const double nose = bounds_of(robot.footprint).high.x;
  const double reach = robot.gripper->mount.x + robot.gripper->depth;
  REQUIRE(reach > nose);
  world.obstacles = {block("wall", {nose + 0.11, 0.0, 0.0}, {0.1, 3.0}, 0.0, 2.0)};
  const auto holds = what_holds(robot, {}, world);
  REQUIRE(holds.size() == 1);
  CHECK(holds[0].way == Approx(reach - nose - 0.01).margin(0.0015));
  CHECK(what_holds(shipped("pioneer_2dx"), {}, world).empty());
  SECTION("and what is between them does not stand in them") {
    world.obstacles.clear();
    world.items = {{"can", 0.033, 0.12, {reach - 0.05, 0.0, 0.0}}};
    CHECK(what_holds(robot, {}, world).empty());
    world.items[0].pose.y = 0.5 * robot.gripper->opening;
    CHECK(what_holds(robot, {}, world).size() == 1);
  }
}

TEST_CASE("robots stand in each other where their parts meet", "[sim][stand]") {
  RobotModel tall = masted();
  tall.parts = {{Part::Block{0.2, 0.2, 0.5}, {.z = 0.25}}, {Part::Block{1.0, 0.2, 0.1}, {.z = 0.75}}};
  tall.footprint = footprint_of(tall.parts);
  RobotModel low = masted();
  low.parts.resize(1);
  low.footprint = footprint_of(low.parts);
  // The low one is under the arm of the other.
  CHECK_FALSE(stand_in_each_other(low, {0.35, 0.0, 0.0}, tall, {}, Extent::solid));
  CHECK(stand_in_each_other(masted(), {0.35, 0.0, 0.0}, tall, {}, Extent::solid));
  CHECK(stand_in_each_other(low, {0.25, 0.0, 0.0}, tall, {}, Extent::solid));
  const RobotModel gripping = shipped("pioneer_2dx_gripper");
  const double nose = bounds_of(gripping.footprint).high.x;
  const Pose2 before{nose + 0.29, 0.1, 0.0};
  CHECK(stand_in_each_other(low, before, gripping, {}, Extent::with_paddles));
  CHECK_FALSE(stand_in_each_other(low, before, gripping, {}, Extent::solid));
  CHECK(way_out_of(tall, {}, low, {0.25, 0.0, 0.0}).way == Approx(0.05).margin(0.0015));
}

TEST_CASE("a world takes a robot where nothing holds it, and nowhere else", "[sim][stand]") {
  WorldModel model;
  model.obstacles = {block("table", {0.0, 0.0, 0.0}, {0.6, 0.6}, 0.7, 0.75)};
  World world(model, {});
  CHECK_FALSE(world.add_robot("one", masted(), {0.3, 0.0, 0.0}));
  CHECK(world.add_robot("two", masted(), {0.7, 0.0, 0.0}));
}

TEST_CASE("FCL and the contacts of a running world agree on who stands in what", "[sim][stand]") {
  int held = 0, free = 0;
  for (const char* name : {"office", "warehouse", "court"}) {
    xml::Diagnostics wrong;
    const auto world = read_world(std::string(ORCA_SOURCE_DIR "/sim/worlds/") + name + ".xml", {}, wrong);
    REQUIRE(world);
    const auto [low, high] = world->bounds();
    RandomStream random(1, name, "poses");
    for (const auto& entry : std::filesystem::directory_iterator(ORCA_SOURCE_DIR "/sim/robots")) {
      if (entry.path().extension() != ".urdf") continue;
      const RobotModel robot = shipped(entry.path().stem());
      detail::Physics physics(*world);
      const std::size_t number = physics.add_robot(robot, {});
      for (int i = 0; i < 60; ++i) {
        const Pose2 pose{random.uniform(low.x, high.x), random.uniform(low.y, high.y),
                         random.uniform(-3.1, 3.1)};
        physics.place_robot(number, pose);
        const double clearance = physics.clearance(number, 1.0);
        const auto there = obstacle_in(robot, pose, *world);
        CAPTURE(name, robot.name, pose.x, pose.y, pose.yaw, clearance, there.value_or("nothing"));
        // The sides of polygons have no inside there.
        if (clearance < -2e-4) CHECK(there);
        if (clearance > 0.0 && there)
          CHECK(std::ranges::any_of(world->obstacles, [&](const Obstacle& o) {
            return o.name == *there && std::holds_alternative<Outline>(o.shape) &&
                   contains(o.shape, pose.position());
          }));
        ++(there ? held : free);
      }
    }
  }
  CHECK(held > 200);
  CHECK(free > 200);
}
