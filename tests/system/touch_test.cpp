// SPDX-License-Identifier: GPL-3.0-or-later
// The reflex of a base that touches something, in a whole system.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

#include "deployer.hpp"
#include "temp_folder.hpp"

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

TEST_CASE(
    "with any avoider a robot backs off from the kerb that its laser overlooks, and reaches goals behind and "
    "aside",
    "[system][touch]") {
  const std::string avoider =
      GENERATE(as<std::string>{}, "LaserAvoid", "VfhPlus", "Dwa", "NdPlus", "PotentialField");
  const TempFolder folder;
  const std::string world = folder.write("low.xml", R"(<world name="low" version="1">
  <room name="hall" from="0 0" to="12 8"/>
  <box name="kerb" x="5" y="4" length="0.3" width="3" height="0.12"/>
  <place name="start" x="2" y="4" yaw="0"/>
</world>)");
  // Dwa does not always come away: docs/limitations.md has its share.
  const int seeds = avoider == "Dwa" ? 5 : 1;
  std::size_t most = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Run run = run_deployer(
        Words{source_file("graphs/pioneer_laser_goto.xml"), "--set", "world=" + world, "--set", "place=start",
              "--set", "avoid=orca." + avoider, "--set", "goals=kerb: 5 4; behind: 3 3; aside: 2 6",
              "--until", "200 s", "--seed", std::to_string(seed)} +
        virtual_clock());
    INFO(avoider << ", seed " << seed << "\n" << run.out << run.err);
    CHECK_FALSE(run.contacts().empty());
    most = std::max(most, run.arrivals().size());
  }
  CHECK(most == 2);
}

TEST_CASE("a robot that starts with its nose near a wall turns away from it", "[system][touch]") {
  const std::string avoider =
      GENERATE(as<std::string>{}, "LaserAvoid", "VfhPlus", "NdPlus", "PotentialField");
  const TempFolder folder;
  const std::string world = folder.write("nose.xml", R"(<world name="nose" version="1">
  <room name="hall" from="0 0" to="10 8"/>
  <place name="nose" x="9.55" y="4" yaw="0"/>
</world>)");
  const Run run = run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--set", "world=" + world,
                                     "--set", "place=nose", "--set", "avoid=orca." + avoider, "--set",
                                     "goals=behind: 3 3; aside: 8 6", "--until", "200 s"} +
                               virtual_clock());
  INFO(avoider << "\n" << run.out << run.err);
  CHECK(run.contacts().empty());
  CHECK(run.arrivals().size() == 2);
}
