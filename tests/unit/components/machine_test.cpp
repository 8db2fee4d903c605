// SPDX-License-Identifier: GPL-3.0-or-later
// The robots that a CollisionMonitor reads from their files.
#include "collision_monitor/machine.hpp"

#include <catch2/catch.hpp>

#include "temp_folder.hpp"

using namespace orca;
using namespace orca::gate;
using Catch::Contains;
using collision::Post;

namespace {

const std::string kRobots = ORCA_SOURCE_DIR "/sim/robots/";

Machine read(const std::string& robot) {
  auto machine = Machine::read(kRobots + robot);
  REQUIRE(machine);
  return std::move(*machine);
}

}  // namespace

TEST_CASE("what a gripper holds fills the room between its paddles, in the heights of the lift", "[gate]") {
  const Machine machine = read("pioneer_2dx_gripper.urdf");
  const Post between{{0.28, 0.0}};
  CHECK(machine.body(false).distance(between) > 0.05);
  CHECK(machine.body(true).distance(between) <= 0.0);
  CHECK(machine.body(true).distance({{0.28, 0.0}, 0.25}) > 0.05);  // above the load
  CHECK(machine.body(false).distance({{0.28, 0.115}}) <= 0.0);     // a paddle
}

TEST_CASE("the body of a synchro base is round, since it does not turn with its wheels", "[gate]") {
  const Machine machine = read("nomad_200.urdf");
  const double reach = machine.body(false).reach();
  for (int i = 0; i < 8; ++i)
    CHECK(machine.body(false).distance({(reach + 0.1) * direction(0.8 * i)}) ==
          Approx(machine.body(false).distance({{reach + 0.1, 0.0}})).margin(1e-3));
}

TEST_CASE("lag and dead time of the base add to the reaction, and its emergency stop is the harder brake",
          "[gate]") {
  const Rules rules = read("pioneer_2dx.urdf").rules(0.15, 0.03);
  CHECK(rules.reaction == Approx(0.3));
  CHECK(rules.gentle.deceleration == 0.5);
  CHECK(rules.hard.deceleration == 3.0);
  CHECK(rules.margin == 0.03);
}

TEST_CASE("a file that is no robot's is refused with all that is wrong", "[gate]") {
  const orca::test::TempFolder folder;
  const auto machine = Machine::read(
      folder.write("r.urdf", "<robot name='r'>\n<orca>\n<drive max_speed='1 kg'/></orca></robot>"));
  REQUIRE_FALSE(machine);
  CHECK_THAT(machine.error().message, Contains("r.urdf:2:1") && Contains("r.urdf:3:"));
  CHECK_FALSE(Machine::read(""));
}
