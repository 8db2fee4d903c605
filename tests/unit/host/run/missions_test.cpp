// SPDX-License-Identifier: GPL-3.0-or-later
// Missions in whole systems: who begins them, what carries them, and who says how they end.
#include <catch2/catch.hpp>

#include <algorithm>

#include "deployer.hpp"
#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Lines = std::vector<std::string>;

namespace {

const std::string kFuser = R"x(
    <component name="fuser" type="orca.MotionCommandFuser"><param name="clients" value="slow; fast"/></component>
    <component name="slow" type="test.Wisher"><param name="mission" value="70"/></component>
    <component name="fast" type="test.Wisher"><param name="mission" value="80"/><param name="weight" value="2"/></component>
    <component name="wheels" type="test.Wheels"/>
    <connect from="slow.motion" to="fuser.motion"/>
    <connect from="fast.motion" to="fuser.motion"/>
    <connect from="fuser.base" to="wheels.motion"/>)x";

// Drives straight at the pillar, and after that back to where it began.
std::string into_the_pillar() {
  return R"x(
    <hardware name="scout" type="orca.hw.Sim">
      <param name="world" value=")x" +
         source_file("tests/data/worlds/pillar.xml") + R"x("/>
      <param name="robot" value=")x" +
         source_file("sim/robots/nomad_scout.urdf") + R"x("/>
      <param name="realism" value="ideal"/>
      <param name="place" value="start"/>
    </hardware>
    <component name="base" type="orca.RobotBaseServer" hardware="scout"/>
    <component name="command" type="orca.Command">
      <param name="goals" value="near: 0.5 0; beyond: 6 0; home: 0 0"/>
      <param name="behaviours" value="goto"/>
    </component>
    <component name="goto" type="orca.Goto"><param name="blocked_after" value="5 s"/></component>
    <component name="fuser" type="orca.MotionCommandFuser"/>
    <connect from="command.goto" to="goto.GotoCoordinateSend"/>
    <connect from="command.clients" to="fuser.ClientListSend"/>
    <connect from="goto.ArrivedPush" to="command.arrived"/>
    <connect from="goto.GoalFailedPush" to="command.failed"/>
    <connect from="goto.MotionCmdPush" to="fuser.motion"/>
    <connect from="fuser.base" to="base.MotionCommandSend"/>
    <connect from="base.OdometryPush" to="goto.odometry"/>)x";
}

// Returns the lines of one component.
Lines lines_of_component(const std::string& name, const RecordedRun& run) {
  Lines lines;
  std::ranges::copy_if(run.warnings, std::back_inserter(lines),
                       [&](const std::string& line) { return line.starts_with(name + ": "); });
  return lines;
}

}  // namespace

TEST_CASE("missions count from 1 in each run, and lines in the log name theirs until it ends",
          "[host][missions]") {
  for (int i = 0; i < 2; ++i) {
    const RecordedRun run =
        record_run("ends=\"errand\"", R"x(<component name="errand" type="test.Errand"/>)x", virtual_run());
    CHECK(run.warnings == Lines{"errand: on the way (mission 1)", "errand: at rest",
                                "errand: on the way (mission 2)", "errand: at rest"});
  }
}

TEST_CASE("the result of a mission is heard even if no component takes it", "[host][missions]") {
  const RecordedRun run =
      record_run("ends=\"errand\"", R"x(<component name="errand" type="test.Errand"/>)x", virtual_run());
  CHECK(run.heard == Lines{"started", "failed home: lost", "failed home: lost", "ended"});
  REQUIRE(run.result.failures.size() == 2);
  CHECK(run.result.failures[0].mission() == 1);
  CHECK(run.result.failures[1].mission() == 2);
  CHECK(run.result.failures[1].origin() == "errand");
}

TEST_CASE("an alarm belongs to the mission that its component has begun", "[host][missions]") {
  const RecordedRun run = record_run(
      "ends=\"errand\"",
      R"x(<component name="errand" type="test.Errand"><param name="throws" value="true"/></component>)x",
      virtual_run());
  REQUIRE(run.alarms.size() == 1);
  CHECK(run.alarms[0].mission() == 1);
}

TEST_CASE("without a client list the fuser's command belongs to the mission of the wish that decides",
          "[host][missions]") {
  RunOptions options = virtual_run();
  options.until = 1s;
  const RecordedRun run = record_run("", kFuser, options);
  REQUIRE_FALSE(lines_of_component("wheels", run).empty());
  CHECK(lines_of_component("wheels", run).back() == "wheels: moves because of fast (mission 80)");
}

TEST_CASE(
    "the mission of the client list wins over those of the behaviours; the cause is the wish that decides",
    "[host][missions]") {
  const RecordedRun run = record_run("ends=\"errand\"", kFuser + R"x(
    <component name="errand" type="test.Errand"><param name="behaviours" value="fast"/></component>
    <connect from="errand.list" to="fuser.ClientListSend"/>)x",
                                     virtual_run());
  const Lines lines = lines_of_component("wheels", run);
  REQUIRE(lines.size() >= 2);
  CHECK(lines[lines.size() - 2] == "wheels: moves because of fast (mission 1)");
  CHECK(lines.back() == "wheels: moves because of fast (mission 2)");
}

TEST_CASE("a goal's mission goes down to the wheels and comes back in its result", "[host][missions]") {
  const RecordedRun run = record_run("ends=\"command\"", into_the_pillar(), virtual_run());
  CHECK(run.result.robots.robots == Lines{"Dewey"});  // its name in the file of the robot
  REQUIRE(run.result.arrivals.size() == 2);
  CHECK(run.result.arrivals[0].name() == "near");
  CHECK(run.result.arrivals[0].mission() == 1);
  CHECK(run.result.arrivals[1].name() == "home");
  CHECK(run.result.arrivals[1].mission() == 3);
  REQUIRE(run.result.failures.size() == 1);
  CHECK(run.result.failures[0].name() == "beyond");
  CHECK(run.result.failures[0].kind() == idl::GOAL_BLOCKED);
  CHECK(run.result.failures[0].mission() == 2);
  REQUIRE(run.result.contacts.size() ==
          1);  // what happens to the wheels happens in the mission that moves them
  CHECK(run.result.contacts[0].mission() == 2);
  const Lines of_base = lines_of_component("base", run);
  REQUIRE_FALSE(of_base.empty());
  CHECK(of_base.front().ends_with(" (mission 2)"));
}
