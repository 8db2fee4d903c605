// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/sim/robot_file.hpp"
#include "orca/sim/world.hpp"
#include "orca/sim/world_file.hpp"
#include "plan.hpp"

using namespace orca::sim;
using orca::sim::test::Plan;

namespace {

constexpr double kClearance = 0.3;

WorldModel office() {
  orca::xml::Diagnostics diagnostics;
  const auto world = read_world(ORCA_SOURCE_DIR "/sim/worlds/office.xml", {}, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(world);
  return *world;
}

}  // namespace

TEST_CASE("every place of the office but the charger's contacts can be reached with 0.3 m of clearance",
          "[sim][office]") {
  const WorldModel world = office();
  REQUIRE(world.place("start") != nullptr);
  const Plan plan(world, world.place("start")->pose.position(), kClearance);
  CHECK(world.places.size() == 21);
  for (const Place& p : world.places) {
    INFO(p.name);
    CHECK(plan.reaches(p.pose.position()) == (p.name != "dock"));
    if (p.name == "dock") CHECK(plan.reaches(p.pose * Vec2{-0.8, 0.0}));
  }
  CHECK_FALSE(plan.reaches({-1.0, 6.0}));
}

TEST_CASE("the office has six rooms, each with a goal, a door and a place before it", "[sim][office]") {
  const WorldModel world = office();
  for (const std::string room : {"office_1", "office_2", "workshop", "kitchen", "library", "meeting"})
    for (const char* suffix : {"", "_door", "_hall"}) CHECK(world.place(room + suffix) != nullptr);
  const Bounds b = world.bounds();
  CHECK(b.high.x - b.low.x == Approx(18.2));
  CHECK(b.high.y - b.low.y == Approx(12.2));
}

TEST_CASE("the shipped scout drives along the office's corridor, from behind the trolley", "[sim][office]") {
  orca::xml::Diagnostics diagnostics;
  const auto scout = read_robot(ORCA_SOURCE_DIR "/sim/robots/nomad_scout.urdf", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(scout);
  World world(office(), {.seed = 1, .realism = Realism::nominal});
  const auto id = world.add_robot("dewey", *scout, {6.8, 6.0, 0.0});
  REQUIRE(id);
  REQUIRE(world.set_velocity_command(*id, 0.5, 0.0));
  for (int i = 0; i < 1000; ++i) {
    world.step();
    REQUIRE(world.contacts().empty());
  }
  CHECK(world.pose(*id).x > 10.8);
  CHECK(std::fabs(world.pose(*id).y - 6.0) < 0.5);  // what its wheels let it drift
}
