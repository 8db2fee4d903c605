// SPDX-License-Identifier: GPL-3.0-or-later
// The readings of a simulated robot, as the rest of the system receives them.
#include <catch2/catch.hpp>

#include "deployer.hpp"

using namespace orca::test;

TEST_CASE(
    "the generic base server delivers laser, infrared, bumper and 100 Hz odometry readings, each with its "
    "own stamp",
    "[system][sensors]") {
  // The run ends when the listener has heard all objects that it waits for; otherwise the test times out.
  const Run run = run_deployer(Words{system_graph("sensors.xml")} + with_test_plugins() + virtual_clock());
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK(run.exit_code() == 0);
  CHECK_FALSE(run.says("listener"));
}

TEST_CASE("a robot without these sensors is refused with the list of what it has", "[system][sensors]") {
  const Run run = run_deployer(
      Words{system_graph("sensors.xml"), "--set", "robot=" + source_file("sim/robots/nomad_scout.urdf")} +
      with_test_plugins() + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("BumperReadingsPush"));
  CHECK(run.says("OdometryPush"));
}
