// SPDX-License-Identifier: GPL-3.0-or-later
// Each kind of alarm that a plugin which misbehaves can cause reaches the listener, with component and hook.
#include <catch2/catch.hpp>

#include <cstdlib>

#include "orca/host/last_words.hpp"
#include "orca/idl/time.hpp"
#include "recorded_run.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;

namespace {

RecordedRun misbehave(const std::string& type, const std::string& params) {
  return record_run("ends=\"counter\"",
                    R"(<component name="bad" type=")" + type + R"(" autonomous="true">)" + params +
                        R"(</component><component name="counter" type="test.LapCounter"/>)",
                    virtual_run());
}

RecordedRun act(const std::string& where, const std::string& deed) {
  return misbehave("test.Hooligan", R"(<param name="where" value=")" + where +
                                        R"("/><param name="deed" value=")" + deed + R"("/>)");
}

RecordedRun throw_in(const std::string& where) {
  return misbehave("test.Misbehaving", R"(<param name="where" value=")" + where + R"("/>)");
}

RecordedRun welcome(const std::string& deed) {
  return record_run("ends=\"host\"",
                    R"x(<component name="arriver" type="test.Arriver"/>
    <component name="host" type="test.Welcomer"><param name="deed" value=")x" +
                        deed + R"x("/></component>
    <connect from="arriver.out" to="host.in"/>)x",
                    virtual_run());
}

}  // namespace

TEST_CASE("a component that changes shared state raises an alarm of that kind, with its name and hook",
          "[host][alarms]") {
  struct Case {
    std::string deed;
    std::string kind;
  };
  for (const Case& c :
       {Case{"locale", "LOCALE"}, Case{"rounding", "FLOATING_POINT"}, Case{"folder", "WORKING_FOLDER"},
        Case{"mask", "SIGNAL_MASK"}, Case{"handler", "SIGNAL_HANDLER"}, Case{"umask", "UMASK"},
        Case{"limit", "RESOURCE_LIMIT"}}) {
    for (const std::string where : {"start", "work"}) {
      const RecordedRun run = act(where, c.deed);
      CAPTURE(c.deed, where);
      REQUIRE(run.alarms.size() == 1);
      const idl::Alarm& alarm = run.alarms[0];
      CHECK(kind_text(alarm) == c.kind);
      CHECK(alarm.source() == "bad");
      CHECK(alarm.hook() == where + "()");
      CHECK(alarm.severity() == idl::ALARM_NOTICE);
      CHECK(alarm.active());
      CHECK_THAT(alarm.text(), Contains(where + "() has "));
      CHECK(run.result.alarms.size() == 1);
    }
  }
}

TEST_CASE("descriptors that a component leaves open are an alarm of its stop()", "[host][alarms]") {
  const RecordedRun run = act("start", "leak");
  REQUIRE(run.alarms.size() == 1);
  CHECK(run.alarms[0].kind() == idl::DESCRIPTORS);
  CHECK(run.alarms[0].source() == "bad");
  CHECK(run.alarms[0].hook() == "stop()");
}

TEST_CASE("fork() is an alarm, once", "[host][alarms]") {
  const LastWords words(EXIT_FAILURE, 3);  // ends the copy
  const RecordedRun run = act("work", "fork");
  REQUIRE(run.alarms.size() == 1);
  CHECK(run.alarms[0].kind() == idl::FORK);
  CHECK(run.alarms[0].source() == "bad");
  CHECK(run.alarms[0].hook() == "work()");
}

TEST_CASE("a component that throws raises an alarm, with the hook that threw", "[host][alarms]") {
  for (const auto& [where, hook] :
       {std::pair{"configure", "configure()"}, std::pair{"start", "start()"}, std::pair{"work", "work()"},
        std::pair{"stop", "stop()"}, std::pair{"destructor", "its destructor"}}) {
    const RecordedRun run = throw_in(where);
    CAPTURE(where);
    REQUIRE(run.result.alarms.size() == 1);
    const idl::Alarm& alarm = run.result.alarms[0];
    CHECK(alarm.kind() == idl::FAILED);
    CHECK(alarm.source() == "bad");
    CHECK(alarm.hook() == hook);
    CHECK(alarm.severity() == idl::ALARM_WARNING);
    CHECK_THAT(alarm.text(), Contains("the wheels came off"));
  }
}

TEST_CASE("a handler that throws is named after its port", "[host][alarms]") {
  const RecordedRun run = record_run("ends=\"counter\"", R"x(
    <component name="bad" type="test.Misbehaving"><param name="where" value="send"/></component>
    <component name="poker" type="test.Poker"/>
    <component name="counter" type="test.LapCounter"/>
    <connect from="poker.goal" to="bad.goal"/>)x",
                                     virtual_run());
  REQUIRE(run.alarms.size() == 1);
  CHECK(run.alarms[0].source() == "bad");
  CHECK(run.alarms[0].hook() == "goal()");
}

TEST_CASE("hardware that fails raises an alarm of the highest severity", "[host][alarms]") {
  const RecordedRun run = record_run("ends=\"counter\"", R"x(
    <hardware name="scout" type="test.Brittle"/>
    <component name="base" type="orca.RobotBaseServer" hardware="scout"/>
    <component name="counter" type="test.LapCounter"><param name="laps" value="20"/></component>)x",
                                     virtual_run());
  REQUIRE(run.alarms.size() == 1);
  CHECK(run.alarms[0].kind() == idl::HARDWARE_FAULT);
  CHECK(run.alarms[0].source() == "scout");
  CHECK(run.alarms[0].hook() == "its strand");
  CHECK(run.alarms[0].severity() == idl::ALARM_CRITICAL);
  CHECK_THAT(run.alarms[0].text(), Contains("the cable is off"));
}

TEST_CASE("an alarm belongs to the mission that the component was working on, and names its cause",
          "[host][alarms]") {
  for (const std::string deed : {"fail", "rounding"}) {
    const RecordedRun run = welcome(deed);
    CAPTURE(deed);
    REQUIRE(run.alarms.size() == 1);
    CHECK(run.alarms[0].source() == "host");
    CHECK(run.alarms[0].mission() == 7);
    CHECK(run.alarms[0].cause().origin() == "arriver");
    CHECK(run.alarms[0].cause().seq() == 2);
    CHECK(to_time_point(run.alarms[0].stamp()) - run.result.start == 100ms);
  }
}

TEST_CASE(
    "a component raises and clears alarms of its own, with mission and cause, and none of the runtime's "
    "kinds",
    "[host][alarms]") {
  const RecordedRun run = welcome("raise");
  REQUIRE(run.alarms.size() == 2);
  for (const idl::Alarm& alarm : run.alarms) {
    CHECK(kind_text(alarm) == "HOUSE_FULL");
    CHECK(alarm.source() == "host");
    CHECK(alarm.severity() == idl::ALARM_WARNING);
  }
  CHECK(run.alarms[0].active());
  CHECK(run.alarms[0].text() == "there is no chair left; bring one");
  CHECK(run.alarms[0].mission() == 7);
  CHECK(run.alarms[0].cause().origin() == "arriver");
  CHECK_FALSE(run.alarms[1].active());
  CHECK(run.alarms[1].text() == "a chair has come");
}

TEST_CASE("a component without fault raises no alarm", "[host][alarms]") {
  CHECK(act("work", "none").alarms.empty());
  CHECK(welcome("none").alarms.empty());
}

TEST_CASE("a plugin that stays in memory because of a thread is an alarm with the plugin's file",
          "[host][alarms]") {
  const RecordedRun run = act("start", "thread");
  REQUIRE(run.result.alarms.size() == 1);
  CHECK(run.result.alarms[0].kind() == idl::PLUGIN_PINNED);
  CHECK(run.result.alarms[0].source() == "test_hooligan.so");
}
