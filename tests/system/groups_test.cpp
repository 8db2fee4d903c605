// SPDX-License-Identifier: GPL-3.0-or-later
// Orders to several components in several processes: groups that are suspended and resumed, and parameters that are set
// together. All obey, or none.
#include <signal.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <functional>
#include <sstream>
#include <thread>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

using Clock = std::chrono::steady_clock;

const std::string kScout = source_file("graphs/scout_goto_processes.xml");

bool comes_true(const std::function<bool()>& condition, Seconds limit) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit * kSlowdown);
  while (!condition()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

// What orcactl ps says of a component; empty if there is no answer.
struct Shown {
  std::string name, type, process, pid, state;
};

Shown shown(const std::string& component) {
  std::istringstream ps(run_orcactl({"ps"}).out);
  for (std::string line; std::getline(ps, line);) {
    std::istringstream words(line);
    Shown one;
    words >> one.name >> one.type >> one.process >> one.pid >> one.state;
    if (one.name == component) return one;
  }
  return {};
}

std::string state_of(const std::string& component) { return shown(component).state; }

bool are_all(const Words& components, const std::string& state) {
  return std::ranges::all_of(components, [&](const std::string& name) { return state_of(name) == state; });
}

// Returns the value of a parameter, as programs get it.
std::string value_of(const std::string& param) {
  const std::string json = run_orcactl({"get", param, "--json"}).out;
  const std::string key = "\"value\": \"";
  const std::size_t at = json.find(key);
  INFO(json);
  REQUIRE(at != std::string::npos);
  return json.substr(at + key.size(), json.find('"', at + key.size()) - at - key.size());
}

// Returns the present speed of the robot [m/s].
double speed() {
  const Run run = run_orcactl({"echo", "base.OdometryPush", "--count", "1"});
  const std::string key = "translational_velocity=\"";
  const std::size_t at = run.out.find(key);
  INFO(run.out << run.err);
  REQUIRE(at != std::string::npos);
  return std::abs(std::stod(run.out.substr(at + key.size())));
}

void stop(Subprocess& program) {
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  const Run run = finish(program, Seconds(5));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
}

}  // namespace

TEST_CASE("the group of a shipped graph stops the robot and lets it go on", "[system][groups]") {
  Subprocess program(deployer({kScout}));
  const Words driving{"goto", "avoid", "fuser"};
  REQUIRE(comes_true([&] { return are_all(driving, "WORK"); }, Seconds(20)));
  REQUIRE(comes_true([] { return speed() > 0.1; }, Seconds(10)));

  CHECK(run_orcactl({"suspend", "avoid"}).exit_code() == 0);
  const Run suspend = run_orcactl({"suspend", "driving"});
  INFO(suspend.err);
  CHECK(suspend.exit_code() == 0);
  CHECK(are_all(driving, "SUSPENDED"));
  CHECK(state_of("base") == "WORK");
  const Run echo = run_orcactl({"echo", "avoid.motion", "--for", "0.3 s"});
  CHECK(echo.says("orcactl: avoid is SUSPENDED: it does no laps, so perhaps nothing passes here"));
  CHECK(run_orcactl({"echo", "base.OdometryPush", "--count", "1"}).err.empty());
  CHECK(comes_true([] { return speed() < 0.01; }, Seconds(3)));
  CHECK(run_orcactl({"set", "goto.max_speed", "0.3", "avoid.margin", "9 cm"}).exit_code() == 0);
  std::istringstream table(suspend.out);
  Words lines;
  for (std::string line; std::getline(table, line);) lines.push_back(line);
  REQUIRE(lines.size() == 4);
  CHECK_THAT(lines[0], Contains("COMPONENT") && Contains("PROCESS") && Contains("BEFORE") && Contains("NOW"));
  CHECK_THAT(lines[1], Catch::Matches("fuser +behaviours +WORK +SUSPENDED"));
  CHECK_THAT(lines[2], Catch::Matches("avoid +behaviours +SUSPENDED +SUSPENDED"));
  CHECK_THAT(lines[3], Catch::Matches("goto +behaviours +WORK +SUSPENDED"));

  CHECK(run_orcactl({"suspend", "driving"}).exit_code() == 0);
  const Run resume = run_orcactl({"resume", "driving", "--json"});
  INFO(resume.err);
  CHECK(resume.exit_code() == 0);
  CHECK(are_all(driving, "WORK"));
  CHECK(resume.out.find("\"component\": \"goto\"") < resume.out.find("\"component\": \"fuser\""));
  CHECK_THAT(resume.out, Contains("\"before\": \"SUSPENDED\"") && Contains("\"now\": \"WORK\""));
  CHECK_THAT(run_orcactl({"log"}).out,
             Contains("an operator has suspended driving") && Contains("an operator has resumed driving"));
  CHECK(comes_true([] { return speed() > 0.1; }, Seconds(10)));
  stop(program);
}

TEST_CASE("if one of a group cannot be suspended, the others go on", "[system][groups]") {
  Subprocess program(deployer(Words{system_graph("groups.xml")} + with_test_plugins()));
  const Words flow{"source", "relay", "sink"};
  REQUIRE(comes_true([&] { return state_of("bad") == "WORK_FAILED" && are_all(flow, "WORK"); }, Seconds(20)));

  const Run refused = run_orcactl({"suspend", "everything"});
  CHECK(refused.exit_code() == 1);
  CHECK(refused.out.empty());
  CHECK_THAT(refused.err,
             Contains("bad: it is WORK_FAILED; only IDLE and WORK can be suspended; all others are "
                      "as before the order"));
  CHECK(are_all(flow, "WORK"));

  CHECK(run_orcactl({"suspend", "flow"}).exit_code() == 0);
  CHECK(are_all(flow, "SUSPENDED"));
  const Run again = run_orcactl({"suspend", "everything"});
  CHECK(again.exit_code() == 1);
  CHECK(are_all(flow, "SUSPENDED"));  // they were so before the order
  CHECK(run_orcactl({"resume", "everything"}).exit_code() == 0);
  CHECK(are_all(flow, "WORK"));
  CHECK(state_of("bad") == "WORK_FAILED");

  const Run misspelt = run_orcactl({"suspend", "flo"});
  CHECK(misspelt.exit_code() == 1);
  CHECK(misspelt.says("there is no component or group \"flo\"; did you mean \"flow\"?"));
  CHECK(run_orcactl({"names", "group"}).out == "bad\neverything\nflow\nrelay\nsink\nsource\n");
  stop(program);
}

TEST_CASE("parameters of several components change together, or not at all", "[system][groups]") {
  Subprocess program(deployer({source_file("graphs/scout_goto_two_localizers.xml")}));
  REQUIRE(comes_true([&] { return are_all({"goto", "avoid"}, "WORK"); }, Seconds(20)));
  const std::string start = value_of("slow.start_yaw");
  const std::string speed = value_of("goto.max_speed");
  const std::string distance = value_of("avoid.stop_distance");

  const Run refused = run_orcactl({"set", "slow.start_yaw", "10 deg", "goto.max_speed", "0.2 m/s",
                                   "avoid.stop_distance", "1 m", "avoid.safe_distance", "0.9 m"});
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("avoid: it must be less than safe_distance; all others are as before the "
                                   "order"));
  CHECK(value_of("slow.start_yaw") == start);
  CHECK(value_of("goto.max_speed") == speed);
  CHECK(value_of("avoid.stop_distance") == distance);

  const Run wrong = run_orcactl({"set", "slow.start_yaw", "77 kg", "goto.max_sped", "0.2 m/s"});
  CHECK(wrong.exit_code() == 1);
  CHECK_THAT(wrong.err, Contains("kg") && Contains("did you mean \"max_speed\"?"));
  CHECK(value_of("slow.start_yaw") == start);
  CHECK(run_orcactl({"set", "goto.max_speed", "0.2", "avoid.stop_distance"}).exit_code() == 2);

  const Run set = run_orcactl({"set", "slow.start_yaw", "0.5", "goto.max_speed", "20 cm/s"});
  INFO(set.err);
  CHECK(set.exit_code() == 0);
  CHECK(value_of("slow.start_yaw") == "0.5");
  CHECK(value_of("goto.max_speed") == "0.2");
  stop(program);
}

TEST_CASE("a component that is too long in a lap keeps its values, and so do the others",
          "[system][groups]") {
  const TempFolder folder;
  const std::string graph =
      folder.write("lap.xml", R"(<graph name="lap" version="1" plugins=")" ORCA_BINARY_DIR R"(/tests/plugins">
  <component name="slow" type="test.SlowStarter" autonomous="true"><param name="lap" value="100 s"/></component>
  <component name="quick" type="test.LapCounter" autonomous="true"><param name="laps" value="1000000"/></component>
</graph>)");
  Subprocess program(deployer({graph}));
  REQUIRE(comes_true([&] { return are_all({"slow", "quick"}, "WORK"); }, Seconds(20)));
  const Run late = run_orcactl({"set", "quick.laps", "77", "slow.delay", "77 s"});
  CHECK(late.exit_code() == 1);
  CHECK_THAT(late.err, Contains("slow: it has not come to the end of a lap in time"));
  CHECK(value_of("quick.laps") == "1000000");
  CHECK(value_of("slow.delay") == "0");
  stop(program);
}

TEST_CASE(
    "an operator cancels a goal of Command, sets others on the way, lets it repeat them, and takes all away",
    "[system][groups]") {
  Subprocess program(deployer({kScout, "--set", "goals=kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8; office: 9 6"}));
  REQUIRE(comes_true(
      [] {
        return are_all({"command", "goto", "avoid", "fuser", "base"}, "WORK");
      },
      Seconds(20)));
  const auto told = [&](const std::string& text) {
    return program.wait_for_output(text, Seconds(15) * kSlowdown);
  };
  const auto times = [&](const std::string& text) {
    const std::string out = program.out();
    int count = 0;
    for (std::size_t at = 0; (at = out.find(text, at)) != std::string::npos; ++at) ++count;
    return count;
  };
  const auto order = [](const Words& words) {
    const Run run = run_orcactl(words);
    INFO(run.err);
    CHECK(run.exit_code() == 0);
  };
  order({"send", "goto.CancelSend", "<GoalFailed name=\"kitchen\" reason=\"supper\"/>"});
  CHECK(told("failed kitchen cancelled: by \"orcactl\", supper"));
  std::this_thread::sleep_for(Seconds(1) * kSlowdown);  // until Command has sent the next goal
  order({"set", "command.rounds", "0", "command.goals", "near: 1.5 6; far: 2.5 6"});
  CHECK(told("failed office cancelled: there are other goals"));
  CHECK(comes_true([&] { return times("arrived near") >= 2; }, Seconds(30)));
  const Run wrong = run_orcactl({"set", "command.goals", "near 1 2"});
  CHECK(wrong.exit_code() == 1);
  CHECK(wrong.says("a goal looks like"));
  order({"set", "command.goals", ""});
  CHECK(comes_true([&] { return times("cancelled: there are other goals") == 2; }, Seconds(5)));
  const std::string before = program.out();
  std::this_thread::sleep_for(Seconds(2));
  CHECK(program.out() == before);
  stop(program);
}

TEST_CASE("a task in a process of its own sets a parameter in another one, and sets it back",
          "[system][groups]") {
  const TempFolder folder;
  const std::string task = folder.write("task.xml",
                                        "<task name=\"test\" version=\"1\"><With set=\"pilot.max_speed\" "
                                        "to=\"0.3 m/s\"><Wait for=\"4 s\"/></With>"
                                        "<Wait for=\"60 s\"/></task>\n");
  ShippedGraph shipped("pioneer_tasks");
  shipped.add("<process name=\"thinking\"/>");
  std::string graph = shipped.text();
  const std::string component = "<component name=\"task\"";
  const std::size_t at = graph.find(component);
  REQUIRE(at != std::string::npos);
  graph.insert(at + component.size(), " process=\"thinking\"");
  Subprocess program(deployer({folder.write("apart.xml", graph), "--set", "task.task=" + task}));
  const auto is = [](const std::string& value) {
    const Run run = run_orcactl({"get", "pilot.max_speed"});
    return run.exit_code() == 0 && run.out.find(value) != std::string::npos;
  };
  CHECK(comes_true([&] { return is("0.3"); }, Seconds(10)));
  CHECK(comes_true([&] { return is("0.5"); }, Seconds(10)));
  stop(program);
}

TEST_CASE("what a task has suspended goes on when the process of the task is killed, and is suspended again",
          "[system][groups]") {
  const TempFolder folder;
  const std::string task = folder.write("task.xml",
                                        "<task name=\"test\" version=\"1\"><Suspend component=\"walk\">"
                                        "<Wait for=\"6 s\"/></Suspend><Wait for=\"60 s\"/></task>\n");
  ShippedGraph shipped("pioneer_roam");
  shipped.add(
      "<process name=\"thinking\"/><profile name=\"apart\">"
      "<component name=\"task\" process=\"thinking\"/></profile>");
  Subprocess program(deployer({folder.write("apart.xml", shipped.text()), "--profile", "sim", "--profile",
                               "apart", "--set", "task=" + task}));
  const auto says = [&](const std::string& text, std::size_t mark) {
    const bool said =
        comes_true([&] { return program.err().find(text, mark) != std::string::npos; }, Seconds(10));
    INFO(program.err());
    CAPTURE(text);
    CHECK(said);
  };
  says("task has suspended it", 0);
  CHECK(comes_true([] { return are_all({"walk"}, "SUSPENDED"); }, Seconds(2)));
  const std::size_t mark = program.err().size();
  kill(std::stoi(shown("task").pid), SIGKILL);
  says("it was suspended for task, which has ended", mark);
  says("task has let it go on", mark);
  says("task has suspended it", mark);  // it has begun again
  const std::size_t again = program.err().size();
  says("task has let it go on", again);
  CHECK(comes_true([] { return are_all({"walk"}, "WORK"); }, Seconds(2)));
  stop(program);
}
