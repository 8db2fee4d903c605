// SPDX-License-Identifier: GPL-3.0-or-later
// Robots that do tasks by sonars alone.
#include <catch2/catch.hpp>

#include <string>

#include "deployer.hpp"
#include "operated.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {}  // namespace

TEST_CASE("a Scout does a task by its sonars alone, and reports the room in which something has changed",
          "[system][tasks]") {
  const TempFolder folder;
  std::string world = read_text(source_file("sim/worlds/office.xml"));
  world.insert(world.rfind("</world>"),
               R"(<box name="crate" x="2.6" y="10.4" length="1.2" width="0.8" height="1 m" comes="1 s"/>
    <box name="crate_2" x="5.3" y="9.2" length="0.6" width="0.9" height="1 m" comes="1 s"/>)");
  const Run run = run_deployer(
      Words{source_file("graphs/scout_tasks.xml"), "--set", "world=" + folder.write("office.xml", world),
            "--set", "task=" + source_file("graphs/tasks/scout_patrol.xml"), "--until", "183 s"} +
          virtual_clock(),
      Seconds(60));
  INFO(run.err);
  CHECK(run.goals() == Words{"kitchen", "library", "meeting", "workshop", "office_2", "office_1"});
  CHECK(run.says("kitchen: something has changed"));
  for (const std::string room : {"library", "meeting", "workshop", "office_2", "office_1"})
    CHECK_FALSE(run.says(room + ": something has changed"));
  CHECK(run.contacts().empty());
}

TEST_CASE("a Scout that was carried off stands and asks where it is, and goes on when somebody says it",
          "[system][tasks]") {
  const TempFolder folder;
  std::string world = read_text(source_file("sim/worlds/office.xml"));
  world.insert(world.rfind("</world>"), R"(<kidnap robot="Dewey" at="8 s" x="14" y="6"/>
    <kidnap robot="Dewey" at="20 s" x="9 m" y="6 m" yaw="180 deg"/>)");
  Operated robot(Words{source_file("graphs/scout_tasks.xml"), "--set",
                       "world=" + folder.write("office.xml", world), "--set",
                       "task=" + source_file("graphs/tasks/scout_patrol.xml"), "--until", "100 s"});
  robot.step("30s");
  robot.order({"send", "localizer.RobotPoseSend", R"(<RobotPose x="9 m" y="6 m" orientation="180 deg"/>)"});
  const Run run = robot.to_the_end();
  INFO(run.err);
  CHECK(run.says("I have lost my way, and stand."));
  CHECK(run.goals() == Words{"kitchen", "library"});
  CHECK(run.contacts().empty());
}

TEST_CASE("a Scout docks by the pose that its sonars give, and drives on", "[system][tasks]") {
  const TempFolder folder;
  const std::string task = folder.write("task.xml", R"(<task name="test" version="1">
  <Drive to="dock" within="150 s"/><Say text="charged"/><Wait for="5 s"/><Drive to="meeting" within="120 s"/>
</task>)");
  const Run run = run_deployer(
      Words{source_file("graphs/scout_tasks.xml"), "--set", "task=" + task, "--set", "place=meeting_hall"} +
      virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"before_dock", "dock", "meeting"});
  CHECK(run.contacts().empty());
}
