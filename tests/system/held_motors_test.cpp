// SPDX-License-Identifier: GPL-3.0-or-later
// Robots whose motors are held for longer than anybody's patience, in virtual time.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

// A paused system in virtual time, which lives on while the test looks.
class Paused {
 public:
  explicit Paused(const Words& words)
      : program_(deployer(words + Words{"--clock", "virtual", "--pace", "0"})) {
    const bool is_there = comes_true([] { return run_orcactl({"pace"}).exit_code() == 0; }, Seconds(20));
    INFO(program_.err());
    REQUIRE(is_there);
  }

  void order(const Words& words) {
    const Run run = run_orcactl(words, Seconds(30));
    INFO(run.err << program_.err());
    REQUIRE(run.exit_code() == 0);
  }
  // Lets time pass, and returns what is said meanwhile.
  std::string step(const std::string& time) {
    const std::size_t before = said().size();
    order({"step", time});
    return said().substr(before);
  }
  void stop() {
    order({"stop"});
    CHECK(finish(program_, Seconds(10)).exit_code() == 0);
  }

 private:
  [[nodiscard]] std::string said() const { return program_.err() + program_.out(); }

  Subprocess program_;
};

}  // namespace

TEST_CASE("who plans a way recovers from nothing while the motors are held, and gives no goal up",
          "[system][goto]") {
  for (const auto& [graph, planner] :
       {std::pair{"graphs/scout_tasks.xml", "pilot"}, {"graphs/pioneer_planner.xml", "planner"}}) {
    CAPTURE(graph);
    Paused system({source_file(graph), "--set", std::string(planner) + ".blocked_after=4"});
    (void)system.step("4s");
    system.order({"estop"});
    const std::string held = system.step("7s");
    CHECK_THAT(held, !Contains("RECOVERS") && !Contains("BLOCKED") && !Contains("failed "));
    system.order({"estop", "--release"});
    CHECK_THAT(system.step("1s"), !Contains("RECOVERS"));
    system.stop();
  }
}

TEST_CASE("the time that a goal may take stands still while the motors are held", "[system][goto]") {
  const TempFolder folder;
  const std::string task = folder.write(
      "task.xml", "<task name=\"there\" version=\"1\"><Drive to=\"kitchen\" within=\"6 s\"/></task>");
  for (const Words& words : {Words{source_file("graphs/scout_goto.xml"), "--set", "command.goal_timeout=6"},
                             {source_file("graphs/pioneer_tasks.xml"), "--set", "task=" + task}}) {
    CAPTURE(words);
    Paused system(words);
    (void)system.step("3s");
    system.order({"estop"});
    CHECK_THAT(system.step("20s"), !Contains("timed out") && !Contains("unanswered"));
    system.order({"estop", "--release"});
    CHECK_THAT(system.step("2s"), !Contains("timed out") && !Contains("unanswered"));
    CHECK_THAT(system.step("2s"), Contains("timed out: not reached within "));
  }
}

TEST_CASE("a robot that is lost looks around, and waits to be found, for as long as its motors are free",
          "[system][goto]") {
  Paused system({source_file("graphs/pioneer_localize.xml"), "--set", "place=library", "--set",
                 "look_around.limit=2", "--set", "planner.lost_wait=2"});
  (void)system.step("500ms");
  system.order({"estop"});
  CHECK_THAT(system.step("5s"), !Contains("has looked around") && !Contains("lost: "));
  system.stop();
}
