// SPDX-License-Identifier: GPL-3.0-or-later
// Whole systems with robots of other kinds than the Scout.
#include <catch2/catch.hpp>

#include "deployer.hpp"

using namespace orca::test;

namespace {

std::string robot_arg(const std::string& robot) {
  return "robot=" + source_file("sim/robots/" + robot + ".urdf");
}

}  // namespace

TEST_CASE("a synchro base with a turret and a holonomic base drive the run of the thesis",
          "[system][robots]") {
  for (const char* robot : {"nomad_200", "omni"}) {
    const Run run = run_deployer(Words{source_file("graphs/scout_goto.xml"), "--set", robot_arg(robot)} +
                                 virtual_clock());
    CAPTURE(robot, run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.arrivals().size() == 3);
    CHECK(run.contacts().empty());
  }
}

TEST_CASE("a holonomic base moves sideways on command", "[system][robots]") {
  const Run run = run_deployer(Words{system_graph("sidestep.xml")} + with_test_plugins() + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
}

TEST_CASE("a graph that wants other bases to move sideways is refused before anything runs",
          "[system][robots]") {
  for (const char* robot : {"nomad_200", "nomad_scout", "barn_base"}) {
    const Run run = run_deployer(Words{system_graph("sidestep.xml"), "--set", robot_arg(robot)} +
                                 with_test_plugins() + virtual_clock());
    CAPTURE(robot, run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.says("HolonomicVelocitySend"));
    CHECK(run.says("MotionCommandSend"));
  }
}
