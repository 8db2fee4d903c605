// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin that throws fails alone, with its text. One that never waits is named.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

struct Thrown {
  std::string what;
  std::string text;  ///< What the error says.
};

const std::vector<Thrown> kThings{{"exception", "the wheels came off"},
                                  {"int", "the int 42"},
                                  {"text", "plain words"},
                                  {"nullptr", "of type decltype(nullptr)"},
                                  {"object", "Oddity"}};

Words misbehaving(const std::string& where, const std::string& what, const Words& clock) {
  return Words{system_graph("misbehaving.xml"), "--set", "where=" + where, "--set", "what=" + what} +
         with_test_plugins() + clock;
}

Run misbehave(const std::string& where, const std::string& what) {
  return run_deployer(misbehaving(where, what, virtual_clock()));
}

Run alone(const std::string& type) {
  return run_deployer(Words{system_graph("one_component.xml"), "--set", "type=" + type} +
                      with_test_plugins() + virtual_clock());
}

void check_fails_alone(const std::string& where, const std::string& hook, const Words& clock) {
  std::vector<Words> commands;
  for (const Thrown& thrown : kThings) commands.push_back(misbehaving(where, thrown.what, clock));
  const std::vector<Run> runs = run_together(commands);
  auto next = runs.begin();
  for (const Thrown& thrown : kThings) {
    const Run& run = *next++;
    CAPTURE(where, thrown.what);
    INFO(run.err);
    CHECK(run.ended);
    CHECK(run.exit_code() == 0);
    const std::string said = run.line_with(thrown.text);
    CHECK(said.find("bad: ") != std::string::npos);
    CHECK(said.find(hook) != std::string::npos);
    CHECK(run.says("counter: counted 30 laps"));
  }
}

}  // namespace

TEST_CASE("a component that throws in a hook or a handler fails alone, with its text, and the others go on",
          "[system][plugins]") {
  check_fails_alone("start", "start()", virtual_clock());
  check_fails_alone("work", "work()", virtual_clock());
  check_fails_alone("stop", "stop()", virtual_clock());
  check_fails_alone("send", "goal", virtual_clock());
  check_fails_alone("query", "robot", virtual_clock());
}

TEST_CASE("a component that has failed makes the exit status 1, unless the graph says that it may",
          "[system][plugins]") {
  for (const auto& [may, code] : {std::pair{"true", 0}, {"false", 1}}) {
    const Run run = run_deployer(Words{system_graph("misbehaving.xml"), "--set", "where=work", "--set",
                                       "what=exception", "--set", std::string("may_fail=") + may} +
                                 with_test_plugins() + virtual_clock());
    CAPTURE(may);
    INFO(run.err);
    CHECK(run.exit_code() == code);
    CHECK(run.says("bad: ended in WORK_FAILED, so the run has failed; if it may, say so in the graph with "
                   "may_fail=\"true\"") == (code == 1));
    CHECK(run.says("counter: counted 30 laps"));
  }
}

TEST_CASE("a component that throws fails alone with a thread per component as well", "[system][plugins]") {
  check_fails_alone("work", "work()", {"--clock", "steady"});
}

TEST_CASE("a component whose destructor throws is named, and the run ends as if nothing had happened",
          "[system][plugins]") {
  for (const Thrown& thrown : kThings) {
    const Run run = misbehave("destructor", thrown.what);
    CAPTURE(thrown.what);
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.line_with(thrown.text).find("bad: its destructor") != std::string::npos);
    CHECK(run.says("counter: counted 30 laps"));
    CHECK(run.trace_hash());
  }
}

TEST_CASE("a component that sends to a failed component, or queries it, gets the reason",
          "[system][plugins]") {
  const Run asked = misbehave("query", "exception");
  INFO(asked.err);
  CHECK(asked.says("poker: asked: "));
  CHECK(asked.says("threw while it answered"));
  const Run sent = misbehave("send", "int");
  INFO(sent.err);
  CHECK(sent.line_with("poker: sent: ").find("ok") != std::string::npos);
  CHECK(sent.says("bad.goal takes nothing, because it has failed"));
}

TEST_CASE("a component that throws in configure() is an error of the graph at its place, and nothing starts",
          "[system][plugins]") {
  for (const Thrown& thrown : kThings) {
    const Run run = misbehave("configure", thrown.what);
    CAPTURE(thrown.what);
    INFO(run.err);
    CHECK(run.exit_code() == kRefusedByComponent);
    CHECK(run.line_with(thrown.text).find("bad") != std::string::npos);
    CHECK(run.says("configure()"));
    if (!kThreadSanitizer)
      CHECK(run.says("misbehaving.xml:10:3: error G062: component \"bad\": configure() threw"));
    CHECK_FALSE(run.says("counted"));
  }
}

TEST_CASE(
    "a component that throws in its constructor is an error of the graph at its place, and nothing starts",
    "[system][plugins]") {
  for (const auto& [type, text] : {std::pair{"test.ThrowsInConstructor", "the wheels came off"},
                                   std::pair{"test.ThrowsIntInConstructor", "the int 42"}}) {
    const Run run = alone(type);
    CAPTURE(type);
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.out.empty());
    const std::string said = run.line_with(text);
    CHECK(said.find("one_component.xml:8:") != std::string::npos);
    CHECK(said.find(type) != std::string::npos);
  }
}

TEST_CASE(
    "with the virtual clock a component that never ends its lap is named, and the run ends within seconds",
    "[system][plugins]") {
  for (const char* how : {"one_lap", "many_laps"}) {
    const Run run = run_deployer(Words{system_graph("hog.xml"), "--set", std::string("how=") + how} +
                                     with_test_plugins() + virtual_clock(),
                                 Seconds(15));
    CAPTURE(how);
    INFO(run.err);
    REQUIRE(run.ended);
    CHECK(run.exit_code() == 1);
    CHECK(run.says("greedy"));
    CHECK(run.ending.wall < Seconds(8) * kSlowdown);
  }
}

TEST_CASE("a component that never ends its lap delays no other component if each has a thread of its own",
          "[system][plugins]") {
  const Run run =
      run_deployer(Words{system_graph("hog.xml"), "--set", "how=one_lap"} + with_test_plugins(), Seconds(15));
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK(run.says("counter: counted 10 laps"));
  CHECK(run.says("greedy"));
}

TEST_CASE(
    "a component that says it is not available yet is named with its text, once, and the exit code is 3",
    "[system][plugins]") {
  const Run run = run_deployer(Words{system_graph("slow_starter.xml"), "--set", "refuses=true"} +
                               with_test_plugins() + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 3);
  CHECK(run.said("the moon is in the wrong phase").size() == 1);
  CHECK(run.line_with("the moon is in the wrong phase").find("late") != std::string::npos);
  CHECK_FALSE(run.says("counted"));
}

TEST_CASE("a component that is not up in time is named, and the system does not start", "[system][plugins]") {
  const Run run = run_deployer(Words{system_graph("slow_starter.xml"), "--set", "delay=1000 s"} +
                               with_test_plugins() + virtual_clock());
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK(run.exit_code() == kRefusedByComponent);
  CHECK(run.says("late"));
  CHECK(run.says("configure() did not return"));
}

TEST_CASE("a type that no plugin holds is reported with the places searched", "[system][plugins]") {
  const Run run = alone("test.Nobody");
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.out.empty());
  CHECK(run.says("test.Nobody"));
  CHECK(run.says(ORCA_BINARY_DIR "/plugins"));
  CHECK(run.says(ORCA_BINARY_DIR "/tests/plugins"));
}

TEST_CASE("--describe of a file that is not a plugin is refused with its name", "[system][plugins]") {
  const TempFolder folder;
  for (const std::string& file : {folder.write("text.so", "no library"), folder.file("missing.so"),
                                  std::string(ORCA_BINARY_DIR "/lib/liborca_idl.so")}) {
    const Run run = run_deployer({"--describe", file});
    CAPTURE(file);
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.out.empty());
    CHECK(run.says(file));
  }
}

TEST_CASE(
    "with the virtual clock a plugin that uses the machine's time is refused, with its place in the graph "
    "and all that it uses",
    "[system][plugins]") {
  const Run run = alone("test.WallClock");
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.out.empty());
  for (const char* used : {"uses usleep, which waits for the machine's clock; use sleep() or lap_every()",
                           "uses rand, which draws random numbers that the run's seed does not decide"}) {
    const std::string said = run.line_with(used);
    CHECK(said.find("one_component.xml:8:") != std::string::npos);
    CHECK(said.find("\"guest\": test.WallClock cannot run in virtual time: test_wall_clock.so") !=
          std::string::npos);
  }
}

TEST_CASE(
    "a plugin for the steady clock only is refused with its author's reason, and runs with the steady clock",
    "[system][plugins]") {
  const Run refused = alone("test.Joystick");
  INFO(refused.err);
  CHECK(refused.exit_code() == 2);
  CHECK(refused.says("runs with the steady clock only (--clock steady): a joystick moves in real time"));
  const Run run = run_deployer(Words{system_graph("one_component.xml"), "--set", "type=test.Joystick"} +
                               with_test_plugins());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
}

TEST_CASE(
    "a plugin whose static initialisation throws is an error of the graph, and the deployer survives it",
    "[system][plugins]") {
  const Run run = alone("test.StaticThrower");
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  const std::string said = run.line_with("the static initialisation smokes");
  CHECK(said.find("one_component.xml:8:") != std::string::npos);
  CHECK(said.find("test_static_thrower.so") != std::string::npos);
}

namespace {

// Writes a graph of twenty components of a plugin that does not go well for ever.
std::string of_twenty(const TempFolder& folder, const std::string& plugin, const std::string& params) {
  std::string graph = "<graph name=\"tired\" version=\"1\" plugins=\"" ORCA_BINARY_DIR
                      "/tests/tired_plugins/" +
                      plugin + "\">\n";
  for (int i = 0; i < 20; ++i)
    graph += "<component name=\"c" + std::to_string(i) + "\" type=\"test.Tired\" autonomous=\"true\">" +
             params + "</component>\n";
  return folder.write("tired.xml", graph + "</graph>\n");
}

// Checks or runs such a graph.
Run with_twenty(const std::string& plugin, const std::string& params, const Words& words) {
  const TempFolder folder;
  return run_deployer(Words{of_twenty(folder, plugin, params)} + words, Seconds(30));
}

}  // namespace

TEST_CASE("a destructor that crashes the second time is an error of its plugin, and not the end of the check",
          "[system][plugins]") {
  const Run run = with_twenty("test_tired_soon", "", {"--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK_THAT(run.err, Contains("test_tired_soon.so") &&
                          Contains("the constructor or destructor of test.Tired ended the process with"));
}

TEST_CASE("a destructor that crashes later ends the run with a name and its plugin", "[system][plugins]") {
  for (const Words& way : {virtual_clock(), Words{}}) {
    const Run run = with_twenty("test_tired_later", "", way + Words{"--until", "1s"});
    INFO(run.err);
    CHECK_THAT(run.err, Contains(": its destructor ended the process with the signal SIGSEGV") &&
                            Contains("the plugin is ") && Contains("test_tired_later.so"));
  }
}

TEST_CASE("a check makes no second object of a type without hardware in its own process",
          "[system][plugins]") {
  const Run run = with_twenty("test_tired_later", "", {"--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
}

TEST_CASE("a constructor that hangs while a graph is checked is an error of its component after 10 s",
          "[system][plugins]") {
  const Run run = with_twenty("test_tired_late", "", {"--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.ending.wall < Seconds(15));
  CHECK_THAT(
      run.err,
      Contains("tired.xml:12:1: error G062: component \"c10\": its constructor did not return within 10 s"));
}

TEST_CASE("a destructor that hangs at the end of a run ends the run with its name after 10 s",
          "[system][plugins]") {
  const TempFolder folder;
  const Words words{of_twenty(folder, "test_tired", "<param name=\"rests\" value=\"true\"/>"), "--until",
                    "1s"};
  for (const Run& run : run_together({words + virtual_clock(), words})) {
    INFO(run.err);
    CHECK(run.ended);
    CHECK(run.exit_code() == 1);
    CHECK_THAT(run.err, Contains("its destructor has not returned within 10 s") && Contains("test_tired.so"));
  }
}
