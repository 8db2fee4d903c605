// SPDX-License-Identifier: GPL-3.0-or-later
// Ports that seek their partner: what they use when the process of the one in use is killed.
#include <signal.h>

#include <catch2/catch.hpp>
#include <regex>
#include <sstream>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

const std::string kName = "scout_goto_two_localizers";
const std::string kGraph = source_file("graphs/scout_goto_two_localizers.xml");

// Returns the expanded graph, in which each choice is a connection of its own, with the first choices alone.
std::string with_first_choices_only() {
  std::istringstream lines(printed(kName));
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (line.find("choice=\"2\"") == std::string::npos)
      text += std::regex_replace(line, std::regex(" choice=\"1\""), "") + "\n";
  return text;
}

const Words kNear{"--set", "command.goals=hall: 3.6 6"};  // about 6 s

// Drives to a goal nearby, kills the process of the localizer in use on the way, and returns the run.
Run drive_and_kill(const std::string& graph, const std::string& until) {
  System system(Words{graph, "--until", until} + kNear);
  const pid_t localizing = system.process("localizing");
  std::this_thread::sleep_for(Seconds(2));
  kill(localizing, SIGKILL);
  return finish(system.program(), Seconds(90));
}

// Returns whether `orcactl ports` has a text.
bool shown_by_orcactl(const std::string& text) {
  const Run run = run_orcactl({"--system", kName, "ports"});
  UNSCOPED_INFO(run.out << run.err);
  return run.out.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("a robot whose localizer is killed on the way reaches its goal by the other one",
          "[system][trading]") {
  const Run run = drive_and_kill(kGraph, "45s");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.failures().empty());
  REQUIRE(run.arrivals().size() == 1);
  CHECK(run.arrivals()[0].name == "hall");
  CHECK(run.says("localizer uses slow.RobotPosePush from now on, because quick is down: its process"));
  CHECK_FALSE(run.says("process localizing is back"));
}

TEST_CASE(
    "after the process of the base was lost it is not known where the robot is, and the goal ends as lost",
    "[system][trading]") {
  System system({kGraph});
  const pid_t base = system.process("base");
  std::this_thread::sleep_for(Seconds(2));
  kill(base, SIGKILL);
  const Run run = finish(system.program(), Seconds(90));
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.arrivals().empty());
  REQUIRE(run.failures().size() == 1);
  CHECK(run.failures()[0] == "failed kitchen lost: it is not known any more where the robot is");
  CHECK(run.says("quick: it is not known any more where the robot is: \"base\" has begun anew"));
}

TEST_CASE("with a fixed connection to that localizer it does not", "[system][trading]") {
  const TempFolder folder;
  const std::string graph = folder.write("fixed.xml", with_first_choices_only());
  const Run run = drive_and_kill(graph, "10s");
  INFO(run.err);
  CHECK(run.arrivals().empty());
  CHECK(run.says("the time limit has ended the run before these were done: command"));
}

TEST_CASE("a port that has moved stays with its new partner when the old one is back", "[system][trading]") {
  const TempFolder folder;
  const std::string text = std::regex_replace(printed(kName), std::regex(" restart=\"temporary\""), "");
  System system({folder.write("returning.xml", text)});
  std::size_t mark = system.mark();
  std::this_thread::sleep_for(Seconds(2));
  kill(system.process("localizing"), SIGKILL);
  system.when("goto: localizer uses slow.RobotPosePush", mark);
  system.when("avoid: localizer uses slow.RobotPosePush", mark);
  system.when("process localizing is back", mark);
  CHECK(shown_by_orcactl("quick.RobotPosePush (choice 1, shm), slow.RobotPosePush (choice 2, in use, shm)"));
  mark = system.mark();
  std::this_thread::sleep_for(Seconds(1));
  CHECK(system.program().err().find("localizer uses", mark) == std::string::npos);
  kill(system.process("spare"), SIGKILL);
  system.when("goto: localizer uses quick.RobotPosePush", mark);
  CHECK(shown_by_orcactl("quick.RobotPosePush (choice 1, in use, shm), slow.RobotPosePush (choice 2, shm)"));
  stop(system);
}

TEST_CASE("the choice holds for a process that is started again", "[system][trading]") {
  System system(Words{kGraph} + kNear);
  std::size_t mark = system.mark();
  std::this_thread::sleep_for(Seconds(2));
  kill(system.process("localizing"), SIGKILL);
  system.when("goto: localizer uses slow.RobotPosePush", mark);
  mark = system.mark();
  const pid_t behaviours = system.process("behaviours");
  kill(behaviours, SIGKILL);
  system.when("process behaviours is back", mark);
  const Run run = finish(system.program(), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
}

TEST_CASE("the next deployer knows which partner a port uses", "[system][trading]") {
  const TempFolder folder;
  std::string text = std::regex_replace(printed(kName), std::regex(" restart=\"temporary\""), "");
  text = std::regex_replace(text, std::regex("<process name=\"spare\""), "$& restart=\"temporary\"");
  text = std::regex_replace(text, std::regex("<graph "), "$&on_supervisor_loss=\"continue\" ");
  const Words graph = Words{folder.write("lasting.xml", text)} + kNear;
  System first(graph);
  std::this_thread::sleep_for(Seconds(2));
  kill(first.process("localizing"), SIGKILL);
  first.when("goto: localizer uses slow.RobotPosePush", 0);
  first.when("process localizing is back", 0);
  const pid_t spare = first.process("spare");
  (void)first.process("base"), (void)first.process("behaviours"), (void)first.process("localizing");
  first.program().send(SIGKILL);
  System second(graph);
  second.when("process behaviours is adopted", 0, Seconds(10));
  second.when("process spare is adopted", 0);
  std::this_thread::sleep_for(Seconds(0.5));
  kill(spare, SIGKILL);
  const Run run = finish(second.program(), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
}

TEST_CASE("in virtual time the robot takes the first choice, and the run is the same each time",
          "[system][trading]") {
  const Run first = run_deployer(Words{kGraph} + virtual_clock(), Seconds(60));
  INFO(first.err);
  CHECK(first.exit_code() == 0);
  CHECK(first.arrivals().size() == 1);
  const Run second = run_deployer(Words{kGraph} + virtual_clock(), Seconds(60));
  REQUIRE(first.trace_hash());
  CHECK(second.trace_hash() == first.trace_hash());
}

TEST_CASE("in virtual time, too, the other localizer takes over when the first one fails",
          "[system][trading]") {
  const Run run = run_deployer(Words{kGraph, "--fail", "quick=throw@5s"} + virtual_clock(), Seconds(60));
  INFO(run.err);
  CHECK(run.arrivals().size() == 1);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("goto: localizer uses slow.RobotPosePush from now on, because quick is down"));
}
