// SPDX-License-Identifier: GPL-3.0-or-later
// Goals that cannot be reached: who says so, why, and what happens next.
#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <regex>
#include <string>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

Run rounds(const Words& more = {}) {
  return run_deployer(Words{source_file("graphs/scout_rounds.xml")} + virtual_clock() + more);
}

// Drives by odometry, from the origin, with a pillar 3 m ahead and a Goto that tells why it gives up.
Run drive(const std::string& goals, const Words& more = {}) {
  return run_deployer(
      Words{system_graph("goto_odometry.xml"), "--profile", "tells", "--set", "goals=" + goals} +
      virtual_clock() + more);
}

// The same, with a Goto that only reports arrivals.
Run drive_untold(const std::string& goals, const Words& more = {}) {
  return run_deployer(Words{system_graph("goto_odometry.xml"), "--set", "goals=" + goals} + virtual_clock() +
                      more);
}

std::string kinds(const Run& run) {
  std::string kinds;
  for (const std::string& line : run.lines())
    kinds += line.substr(0, line.find(' ', line.find(' ') + 1)) + "; ";
  return kinds.substr(0, kinds.find("trace-hash"));
}

// The shipped Scout with these goals, as a file.
std::string scout_with(const TempFolder& folder, const std::string& name, const std::string& goals) {
  std::string graph = read_text(source_file("graphs/scout_goto.xml"));
  graph = std::regex_replace(graph, std::regex("\\.\\./sim/"), source_file("sim/"));
  return folder.write(name, std::regex_replace(graph, std::regex("name=\"goals\" default=\"[^\"]*\""),
                                               "name=\"goals\" default=\"" + goals + "\""));
}

}  // namespace

TEST_CASE("the goals are driven to in as many rounds as the graph says, and without end if it says 0",
          "[system][goals]") {
  const auto rounds = [](const std::string& number) {
    return run_deployer(Words{source_file("graphs/scout_goto.xml"), "--set", "goals=near: 1.5 6; far: 2.5 6",
                              "--set", "rounds=" + number, "--until", "60s"} +
                        virtual_clock());
  };
  const Run twice = rounds("2");
  INFO(twice.err);
  CHECK(twice.exit_code() == 0);
  CHECK(kinds(twice) == "arrived near; arrived far; arrived near; arrived far; ");
  const Run endless = rounds("0");
  CHECK(endless.arrivals().size() > 6);
  CHECK(endless.arrivals().back().t > 50.0);
}

TEST_CASE("other goals that are set on the way take the place of all, and the one on the way is cancelled",
          "[system][goals]") {
  const TempFolder folder;
  const std::string far = scout_with(folder, "far.xml", "kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8; office_2: 9 2");
  const std::string near = scout_with(folder, "near.xml", "near: 1.5 6; door: 3 6");
  const Run run = run_deployer(Words{far, "--change", near + "@4s"} + virtual_clock());
  INFO(run.out << run.err);
  CHECK(kinds(run) == "failed kitchen; arrived near; arrived door; ");
  REQUIRE(run.failures().size() == 1);
  CHECK(run.failures()[0].starts_with("failed kitchen cancelled: there are other goals"));
  CHECK(run.says("command: work() failed: not reached: kitchen (1 of 3 goals)"));
  CHECK(run.contacts().empty());
}

TEST_CASE("a robot whose goals are all taken away stands until it gets others", "[system][goals]") {
  const TempFolder folder;
  const std::string far = scout_with(folder, "far.xml", "kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8");
  const std::string none = scout_with(folder, "none.xml", "");
  const Run held = run_deployer(Words{far, "--change", none + "@4s", "--until", "40s"} + virtual_clock());
  INFO(held.out << held.err);
  CHECK(held.exit_code() == 0);
  CHECK(kinds(held) == "failed kitchen; ");
  const std::string near = scout_with(folder, "near.xml", "near: 1.5 6");
  const Run on =
      run_deployer(Words{far, "--change", none + "@4s", "--change", near + "@30s"} + virtual_clock());
  INFO(on.out << on.err);
  CHECK(kinds(on) == "failed kitchen; arrived near; ");
  CHECK(on.arrivals().back().t > 30.0);
}

TEST_CASE("the shipped rounds: the walled-in goal is reported as blocked, and the next one is reached",
          "[system][goals]") {
  const Run run = rounds();
  INFO(run.out << run.err);
  CHECK(kinds(run) == "arrived lab; failed archive; arrived store; ");
  REQUIRE(run.failures().size() == 1);
  CHECK(run.failures()[0].starts_with("failed archive blocked: no nearer than "));
  CHECK(run.contacts().empty());
  CHECK(run.arrivals().back().t < 120.0);
}

TEST_CASE("a goal that was not reached makes the Command fail in the end, which the graph waits for: exit 1",
          "[system][goals]") {
  const Run run = rounds();
  CHECK(run.exit_code() == 1);
  CHECK(run.says("command: work() failed: not reached: archive (1 of 3 goals)"));
  const Run without = rounds({"--set", "goals=lab: 2 3 > 2 5.4 > 2 6.5"});
  INFO(without.err);
  CHECK(without.exit_code() == 0);
  CHECK(without.failures().empty());
}

TEST_CASE("the lines about a goal that fails name its mission, and no other does", "[system][goals]") {
  const Run run = rounds();
  INFO(run.err);
  CHECK(run.says("goal \"archive\" was not reached; blocked"));
  CHECK(run.says("(mission 2)"));
  CHECK_FALSE(run.says("(mission 1)"));
  for (const std::string& line : run.said("(mission 3)"))
    CHECK_THAT(line, Contains("alarm BLOCKED is over: it drives to \"store\""));
}

TEST_CASE("the shipped rounds have one trace hash, with fiber and baton", "[system][goals]") {
  const Words graph{source_file("graphs/scout_rounds.xml"), "--clock", "virtual", "--executor"};
  const Run baton = run_deployer(graph + Words{"baton"}, Seconds(120));
  REQUIRE(baton.trace_hash());
  CHECK(baton.trace_hash() == run_deployer(graph + Words{"baton"}, Seconds(120)).trace_hash());
  if (!kThreadSanitizer)  // which does not support fibers
    CHECK(baton.trace_hash() == run_deployer(graph + Words{"fiber"}, Seconds(120)).trace_hash());
}

TEST_CASE("a goal that Goto refuses is reported at once with the reason, and the next one is driven to",
          "[system][goals]") {
  const Run run = drive("high: 0.5 0 > 1 0 1.5; low: 1 0");
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 1);
  REQUIRE(run.failures().size() == 1);
  CHECK(run.failures()[0].starts_with("failed high refused: it lies so far above or below the robot"));
  REQUIRE(run.arrivals().size() == 1);
  CHECK(run.arrivals()[0].name == "low");
  CHECK(run.arrivals()[0].t < drive("low: 1 0").arrivals().at(0).t + 0.5);
}

TEST_CASE("a Door that Command sends arrives at Goto as a Door, which is passed or refused by its width",
          "[system][goals]") {
  const Run run = rounds({"--set",
                          "goals=slit: door 2 4.5 90 0.4 > 2 6.5; gate: door 2 4.5 90 1; "
                          "lab: door 2 4.5 90 1 > 2 6.5; hall: door 2 4.5 90 1 > 2 3"});
  INFO(run.out << run.err);
  REQUIRE(run.failures().size() == 1);
  CHECK(run.failures()[0] == "failed slit refused: it is a door narrower than Goto's door_room");
  REQUIRE(run.arrivals().size() == 3);
  CHECK(run.arrivals()[0].name == "gate");
  CHECK(std::abs(run.arrivals()[0].y - 4.5) < 0.2);
  CHECK(run.arrivals()[1].y > 6.0);
  CHECK(run.arrivals()[2].y < 3.5);  // through the same door, the other way
  CHECK(run.contacts().empty());
}

TEST_CASE("after a goal that was refused nothing is left of its route", "[system][goals]") {
  const Run run = drive("high: 0 -2 > 1 0 1.5; low: 1 0");
  REQUIRE(run.arrivals().size() == 1);
  CHECK(run.arrivals()[0].t < drive("low: 1 0").arrivals().at(0).t + 0.5);  // it did not drive by 0 -2
}

TEST_CASE("a goal that takes longer than goal_timeout has timed out, and the next one is driven to",
          "[system][goals]") {
  const Run run = drive("far: -1 0 > 2 0; home: 0 0", {"--set", "goal_timeout=5 s"});
  INFO(run.out << run.err);
  CHECK(kinds(run) == "failed far; arrived home; ");
  REQUIRE(run.failures().size() == 1);
  CHECK(run.failures()[0] == "failed far timed out: not reached within 5 s");
}

TEST_CASE("a robot that touches what stands in its way gives up the goal behind it and drives away",
          "[system][goals]") {
  const Run run = drive("beyond: 6 0; home: 0 0", {"--set", "blocked_after=5 s"});
  INFO(run.out << run.err);
  CHECK(run.contacts().size() == 1);
  REQUIRE(run.failures().size() == 1);
  CHECK(run.failures()[0].starts_with("failed beyond blocked: "));
  REQUIRE(run.arrivals().size() == 1);
  CHECK(run.arrivals()[0].name == "home");
}

TEST_CASE("where Goto tells only arrivals, Command itself gives a goal up after goal_timeout",
          "[system][goals]") {
  const Run run =
      drive_untold("beyond: 6 0; home: 0 0", {"--set", "goal_timeout=20 s", "--set", "blocked_after=5 s"});
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 1);
  REQUIRE(run.failures().size() == 1);
  CHECK(run.failures()[0] == "failed beyond unanswered: no arrival within 20 s");
  REQUIRE(run.arrivals().size() == 1);
  CHECK(run.arrivals()[0].name == "home");
}

TEST_CASE("a goal may have more via points than Goto's queue has places", "[system][goals]") {
  std::string goals = "far: ";
  for (int i = 1; i <= 40; ++i) goals += std::to_string(i * 0.05) + " 0 > ";
  const Run run = drive_untold(goals + "2 0");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 1);
  CHECK(std::abs(run.arrivals()[0].x - 2.0) < 0.2);
}

TEST_CASE("at the prompt a goal that fails is no reason not to ask for the next", "[system][goals]") {
  Subprocess program(
      deployer(Words{system_graph("goto_odometry.xml"), "--profile", "tells", "--set", "goals="} +
               virtual_clock()),
      {.input = "high: 1 0 1.5\nlow: 1 0\n\n"});
  const Run run = finish(program, Seconds(30));
  INFO(run.out << run.err);
  CHECK(kinds(run) == "failed high; arrived low; ");
}

TEST_CASE("while the prompt waits, orders of an operator are taken, and what has been typed stays",
          "[system][goals]") {
  Subprocess program(
      deployer({source_file("graphs/scout_goto.xml"), "--set", "goals=", "--name", "prompt_test"}),
      {.keep_input_open = true});
  REQUIRE(program.wait_for_output("empty line to end)? ", Seconds(20)));
  program.write_input("far: no place\nty");  // the first line is no goal, and the prompt comes again
  REQUIRE(program.wait_for_output("error", Seconds(10)));
  const auto go = [](const Words& goal) {
    return run_orcactl(Words{"--system", "prompt_test", "go"} + goal);
  };
  CHECK_THAT(go({}).out, Contains("command: no goal"));
  CHECK(go({"1.3", "6"}).exit_code() == 0);
  REQUIRE(program.wait_for_output("arrived point_1", Seconds(30)));
  program.write_input("ped: 1.6 6\n");
  CHECK(program.wait_for_output("arrived typed", Seconds(30)));
  program.send(SIGTERM);
  CHECK(finish(program, Seconds(10)).exit_code() == 0);
}

TEST_CASE("a behaviour gets another name where others require it, and the one of before again",
          "[system][goals]") {
  const TempFolder folder;
  // A fixed parameter is for new code.
  const std::string new_code = GENERATE("", "<param name=\"sync\" value=\"period\"/>");
  const auto named = [&](const std::string& name) {
    const std::string text = std::regex_replace(read_text(source_file("graphs/scout_goto.xml")),
                                                std::regex("\\bavoid\\b(?=[.\"])"), name);
    std::string graph = std::regex_replace(text, std::regex("\"\\.\\./"), "\"" + source_file(""));
    if (name == "dodge") graph.insert(graph.find("<param name=\"required\""), new_code);
    return folder.write(name + ".xml", graph);
  };
  const Run virtually = run_deployer(Words{named("avoid"), "--until", "20 s", "--change",
                                           named("dodge") + "@3s", "--change", named("avoid") + "@6s"} +
                                     virtual_clock());
  INFO(virtually.err);
  CHECK(virtually.exit_code() == 0);
  CHECK(virtually.arrivals().size() == 1);  // by the new behaviour, and not after a while of standing
  Subprocess program(deployer({named("avoid")}));
  const auto works = [] { return run_orcactl({"ps"}).out.find("WORK") != std::string::npos; };
  REQUIRE(comes_true(works, Seconds(20)));
  for (const char* const name : {"dodge", "avoid"}) {
    const Run applied =
        run_orcactl({"apply", named(name), "--tryout", "0.3s", "--probation", "0.3s"}, Seconds(30));
    INFO(applied.err << program.err());
    REQUIRE(applied.exit_code() == 0);
    CHECK_THAT(run_orcactl({"get", "fuser.required"}).out, Contains(name));
  }
  const Run misspelt = run_orcactl({"set", "command.behaviours", "goto; avoit"});
  CHECK(misspelt.exit_code() == 1);
  CHECK_THAT(misspelt.err, Contains("no behaviour \"avoit\" is connected"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(program, Seconds(10)).exit_code() == 0);
}
