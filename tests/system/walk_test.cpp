// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of graphs/random_walk.xml: a robot that drives about.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

Run walk(const Words& more) {
  return run_deployer(Words{source_file("graphs/random_walk.xml"), "--until", "300 s"} + virtual_clock() +
                      more);
}

}  // namespace

TEST_CASE("the Scout drives about the office for five minutes and touches nothing, at every realism",
          "[system][walk]") {
  for (const char* realism : {"ideal", "nominal", "harsh", "recorded"}) {
    for (const char* seed : {"1", "2", "3"}) {
      const Run run = walk({"--set", std::string("realism=") + realism, "--seed", seed});
      INFO(run.err);
      CAPTURE(realism, seed);
      CHECK(run.exit_code() == 0);
      CHECK(run.contacts().empty());
    }
  }
}

TEST_CASE("the same seed gives the same walk, another seed another", "[system][walk]") {
  const auto hash = walk({"--seed", "5"}).trace_hash();
  REQUIRE(hash.has_value());
  CHECK(walk({"--seed", "5"}).trace_hash() == hash);
  CHECK(walk({"--seed", "6"}).trace_hash() != hash);
}

TEST_CASE(
    "a behaviour whose laps are as far apart as a command may be old drives without a line about ceased "
    "commands",
    "[system][walk]") {
  // A round of the Scout's sonars takes 200 ms, and after 200 ms without a command the base stands.
  const TempFolder folder;
  const std::string graph = folder.write("rounds.xml", R"(<graph name="rounds" version="1">
  <hardware name="scout" type="orca.hw.Sim">
    <param name="world" value=")" + source_file("sim/worlds/office.xml") +
                                                           R"("/>
    <param name="robot" value=")" + source_file("sim/robots/nomad_scout.urdf") +
                                                           R"("/>
    <param name="place" value="start"/>
  </hardware>
  <component name="base" type="orca.RobotBaseServer" hardware="scout"/>
  <component name="walk" type="orca.RandomWalk" on="sonar"/>
  <component name="fuser" type="orca.MotionCommandFuser"><param name="clients" value="walk"/></component>
  <connect from="base.SonarRangeReadingsPush" to="walk.sonar"/>
  <connect from="walk.motion" to="fuser.motion"/>
  <connect from="fuser.base" to="base.MotionCommandSend"/>
</graph>)");
  const Run run = run_deployer(Words{graph, "--until", "30 s"} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_FALSE(run.says("no motion command"));
  const Run silent =
      run_deployer(Words{graph, "--until", "30 s", "--fail", "fuser=silent@10s"} + virtual_clock());
  INFO(silent.err);
  CHECK(silent.says("no motion command for 200 ms"));
}
