// SPDX-License-Identifier: GPL-3.0-or-later
// The reflex of a base that touches something, in a whole system.
#include <catch2/catch.hpp>

#include <string>

#include "deployer.hpp"

using namespace orca::test;

namespace {

Run into_the_pillar() {
  return run_deployer(Words{system_graph("laser.xml"), "--set", "behaviours=goto", "--until", "30 s"} +
                      virtual_clock());
}

}  // namespace

TEST_CASE("a robot that drives into a pillar stands there, says why once, and does not push on",
          "[system][touch]") {
  const Run run = into_the_pillar();
  INFO(run.err);
  CHECK(run.contacts().size() == 1);
  CHECK(run.arrivals().empty());
  const std::string reason = "the base stands: its bumper \"front\" is pressed; ask for another direction";
  const auto first = run.err.find(reason);
  REQUIRE(first != std::string::npos);
  CHECK(run.err.find(reason, first + 1) == std::string::npos);
}

TEST_CASE("the shipped Scout and Pioneer stand by what their bumpers feel", "[system][touch]") {
  const std::string robot = GENERATE(as<std::string>{}, "nomad_scout", "pioneer_2dx");
  const Run run =
      run_deployer(Words{system_graph("goto_odometry.xml"), "--set", "goals=beyond: 6 0", "--set",
                         "robot=" ORCA_SOURCE_DIR "/sim/robots/" + robot + ".urdf", "--until", "15 s"} +
                   virtual_clock());
  INFO(run.err);
  CHECK(run.contacts().size() == 1);
  CHECK(run.says("the base stands: its bumper \"front\" is pressed; ask for another direction"));
}
