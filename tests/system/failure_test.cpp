// SPDX-License-Identifier: GPL-3.0-or-later
// A behaviour of a shipped graph fails while the robot drives: the robot is stopped, and the screen says why.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>
#include <optional>
#include <regex>
#include <set>

#include "deployer.hpp"
#include "public_data.hpp"
#include "shipped_graph.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"
#include "terminal.hpp"

using namespace orca::test;

namespace {

// A robot of a shipped graph, and the behaviours that its fuser listens to.
struct Robot {
  std::string graph;
  std::string context;  // of its components, as "dewey/"
  std::vector<std::string> behaviours;
  double deceleration = 3.0;  // [m/s^2] with which it stops in an emergency
};

const std::vector<Robot> kRobots{
    {"scout_goto", "", {"goto", "avoid"}},
    {"scout_goto_processes", "", {"goto", "avoid"}},
    {"scout_goto_two_localizers", "", {"goto", "avoid"}},
    {"two_machines", "", {"goto", "avoid"}},
    {"scout_real_time", "", {"goto", "avoid"}},
    {"scout_from_afar", "", {"goto", "avoid"}},
    {"scout_behaviours", "", {"goto", "avoid"}},
    {"scout_gallery", "", {"goto", "avoid"}},
    {"scout_rounds", "", {"goto", "avoid"}},
    {"scout_odometry", "", {"goto", "avoid"}},
    {"scout_hospital", "", {"goto", "avoid"}},
    {"pioneer_laser_goto", "", {"goto", "avoid"}},
    {"pioneer_one_core", "", {"goto", "avoid"}},
    {"pioneer_people", "", {"goto", "avoid"}},
    {"pioneer_follow", "", {"follow", "avoid"}},
    {"camera", "", {"follow", "avoid"}},
    {"scout_wall", "", {"follow", "avoid"}},
    {"courier_depot", "", {"goto", "avoid"}},
    {"pioneer2dx_sick", "", {"goto", "avoid"}},
    {"pioneer_fetch", "", {"goto", "avoid", "porter"}},
    {"create2_rplidar", "", {"goto", "avoid"}},
    {"player_robot", "", {"goto", "avoid"}},
    {"peoplebot", "", {"goto", "avoid"}},
    {"nomad_scout", "", {"goto", "avoid"}},
    {"nomad_200", "", {"goto", "avoid"}},
    {"nomad_xr4000", "", {"goto", "avoid"}, 1.5},
    {"pioneer_planner", "", {"planner"}},
    {"pioneer_planner_parts", "", {"pilot"}},
    {"warehouse_scanner", "", {"planner"}},
    {"pioneer_localize", "", {"planner", "look_around"}},
    {"team_robot", "", {"planner", "look_around"}},
    {"pioneer_tasks", "", {"pilot", "dock", "traverse", "look_around"}},
    {"pioneer_roam", "", {"pilot", "dock", "traverse", "look_around"}},
    {"pioneer_fetch_task", "", {"pilot", "porter", "dock", "traverse", "look_around"}},
    {"scout_localize", "", {"goto", "avoid"}},
    {"scout_tasks", "", {"pilot", "dock"}},
    {"pioneer_slam", "", {"walk", "avoid"}},
    {"pioneer_map", "", {"planner"}},
    {"calibrate", "", {"goto", "avoid"}},
    {"random_walk", "", {"walk", "avoid"}},
    {"two_robots", "dewey/", {"goto", "avoid"}},
    {"two_robots", "huey/", {"goto", "avoid"}},
    {"five_robots", "dewey/", {"goto", "avoid"}},
    {"five_robots", "huey/", {"goto", "avoid"}},
    {"five_robots", "louie/", {"goto", "avoid"}},
    {"five_robots", "donald/", {"goto", "avoid"}},
    {"five_robots", "daisy/", {"goto", "avoid"}},
};

// Driven by a person, in real time.
const Robot kTeleop{"scout_teleop", "", {"teleop", "avoid"}};
// Driven by another program; rehearsed in player_server_test.cpp.
const Robot kPlayer{"scout_player", "", {"player", "avoid"}};

const Words kHows{"silent", "throw", "hang", "slow"};

constexpr double kFailsAt = 5.0;
constexpr double kSeenFor = 10.0;
// The longest silence of a behaviour that announces 100 ms, less what had passed of the period, and a watch period.
constexpr double kStopLimit = 0.3 + 0.02;
constexpr double kRestLimit = 0.5;  // [s] from the failure until a robot is at rest that brakes with 3 m/s^2
constexpr double kSpeed = 0.5;      // [m/s] at which it fails

// A behaviour that fails, and how.
struct Failure {
  Robot robot;
  std::string behaviour;
  std::string how;
};

// Returns the options that let it fail [s] after the start, and that end the run.
Words options(const Failure& failure, double at, double end) {
  const auto seconds = [](double time) { return std::to_string(time) + "s"; };
  return {"--until", seconds(end), "--fail",
          failure.robot.context + failure.behaviour + "=" + failure.how + "@" + seconds(at)};
}

// Returns the other robots of the graph.
std::vector<std::string> contexts_beside(const Robot& robot) {
  std::vector<std::string> contexts;
  for (const Robot& other : kRobots)
    if (other.graph == robot.graph && other.context != robot.context) contexts.push_back(other.context);
  return contexts;
}

std::string watched(const Robot& robot) {
  ShippedGraph graph(robot.graph);
  graph.watch_motion(robot.context + "base");
  for (const std::string& other : contexts_beside(robot)) graph.watch_motion(other + "base");
  return graph.text();
}

Run drive(const Failure& failure, const Words& arguments) {
  const TempFolder folder;
  return run_deployer(Words{folder.write("graph.xml", watched(failure.robot))} +
                      options(failure, kFailsAt, kFailsAt + kSeenFor) + arguments + virtual_clock());
}

// Returns the time of the last line of the log that holds a text [s].
std::optional<double> last_time(const Run& run, const std::string& text) {
  std::optional<double> time;
  for (const std::string& line : run.said(text))
    if (line.starts_with("[")) time = std::strtod(line.c_str() + 1, nullptr);
  return time;
}

// Checks that the robot moved until the behaviour failed, that it rests soon afterwards, for good, and that it is
// said why: by the fuser, or before it by a task that has heard of the failure. A failure begins with the first lap that fails.
void check_stops(const Run& run, const Failure& failure, double at, double slowdown = 1.0) {
  const auto& [robot, behaviour, how] = failure;
  const auto fails = last_time(run, " " + robot.context + behaviour + ": fails from now on");
  auto stopped = last_time(
      run, robot.context + "fuser: stops the robot: nothing is heard of the behaviour \"" + behaviour + "\"");
  if (!stopped)
    stopped = last_time(run, " task: alarm QUESTION: My " + behaviour + " has failed, and I stand.");
  const auto rests = last_time(run, " " + robot.context + "watch: rests after");
  REQUIRE(fails);
  REQUIRE(stopped);
  REQUIRE(rests);
  CHECK(*fails >= at);
  CHECK(*stopped >= *fails);
  CHECK(*stopped <= *fails + kStopLimit * slowdown);
  CHECK(*rests > *fails);
  CHECK(*rests <= *fails + (kRestLimit + kSpeed / robot.deceleration - kSpeed / 3.0) * slowdown);
  CHECK(last_time(run, " " + robot.context + "watch: moves after") < rests);
  CHECK(run.contacts().empty());
}

void check_goes_on(const Run& run, const std::string& context) {
  CAPTURE(context);
  CHECK_FALSE(last_time(run, " " + context + "fuser: "));
  CHECK(last_time(run, " " + context + "watch: drives on after") > kFailsAt + kSeenFor / 2);
}

// The ways in which a behaviour fails that a run tries: all in the slow tests, else one after the other.
Words some_hows() {
  static std::size_t next = 0;
  return is_slow_run() ? kHows : Words{kHows[next++ % kHows.size()]};
}

void check_failures_of(const Robot& robot, const Words& arguments) {
  for (const std::string& behaviour : robot.behaviours) {
    for (const std::string& how : some_hows()) {
      const Failure failure{robot, behaviour, how};
      CAPTURE(robot.graph, robot.context, behaviour, how);
      const Run run = drive(failure, arguments);
      INFO(run.err);
      check_stops(run, failure, kFailsAt);
      for (const std::string& other : contexts_beside(robot)) check_goes_on(run, other);
    }
  }
}

// A run that a person drives straight ahead.
class DrivenByHand {
 public:
  explicit DrivenByHand(const Failure& failure)
      : program_(Words{"/usr/bin/env", "XDG_RUNTIME_DIR=" + folder_.path().string()} +
                 deployer(Words{folder_.write("graph.xml", watched(failure.robot)), "--set",
                                "keyboard=" + terminal_.name()} +
                          options(failure, kAt, kAt + 2.0))) {}

  void press() const { terminal_.press("w"); }
  [[nodiscard]] bool ends_within(Seconds limit) { return program_.wait(limit).has_value(); }
  [[nodiscard]] Run result() { return finish(program_, Seconds(10)); }

  static constexpr double kAt = 2.0;  // [s]

 private:
  const TempFolder folder_;
  const Terminal terminal_;
  Subprocess program_;
};

// Returns each behaviour that a fuser of a shipped graph listens to, as "two_robots: dewey/goto".
std::set<std::string> behaviours_of(const std::string& graph) {
  const std::string text = printed(graph);
  const std::regex fuser("<component name=\"([^\"]+)\" type=\"orca.MotionCommandFuser\"");
  const std::regex connection("<connect from=\"([^\"]+)\\.[^\".]+\" to=\"([^\"]+)\\.motion\"");
  const auto found = [&](const std::regex& pattern) {
    return std::vector<std::smatch>(std::sregex_iterator(text.begin(), text.end(), pattern), {});
  };
  std::set<std::string> fusers;
  for (const std::smatch& match : found(fuser)) fusers.insert(match[1]);
  std::set<std::string> behaviours;
  for (const std::smatch& match : found(connection))
    if (fusers.contains(match[2])) behaviours.insert(graph + ": " + match[1].str());
  CHECK(behaviours.empty() == fusers.empty());
  return behaviours;
}

}  // namespace

TEST_CASE("every behaviour of every shipped graph has its rehearsal", "[system][failure]") {
  std::set<std::string> shipped;
  // Nothing moves in these: their robots are recordings, or another system's.
  const std::set<std::string> still{"replay", "intel_log", "localize_log", "ros2_robot"};
  for (const std::string& graph : shipped_graphs())
    if (!still.contains(graph)) shipped.merge(behaviours_of(graph));
  // It may be silent, since a task suspends it: the robot stands then without a word, until it has a goal.
  CHECK(shipped.erase("pioneer_roam: walk") == 1);
  std::vector<Robot> robots = kRobots;
  robots.push_back(kTeleop);
  robots.push_back(kPlayer);
  std::set<std::string> rehearsed;
  for (const Robot& robot : robots)
    for (const std::string& behaviour : robot.behaviours)
      rehearsed.insert(robot.graph + ": " + robot.context + behaviour);
  CHECK(shipped == rehearsed);
}

TEST_CASE(
    "silence, an exception, a hang or slowness of any behaviour stops its robot for good, and it is said "
    "why; "
    "the other robots go on",
    "[system][failure]") {
  for (const Robot& robot : kRobots) {
    const TempFolder folder;
    check_failures_of(robot, needed_arguments(robot.graph, folder));
  }
}

TEST_CASE("a behaviour that fails in the real hospital stops the robot, too", "[system][failure][data]") {
  const std::string map = public_data("stage_maps/hospital.png");
  if (!map.empty()) check_failures_of({"scout_hospital", "", {"goto", "avoid"}}, {"--set", "map=" + map});
}

TEST_CASE("a robot that a person drives is stopped when Teleop or the avoider fails",
          "[system][failure][quiet]") {
  for (const std::string& behaviour : kTeleop.behaviours) {
    std::vector<std::unique_ptr<DrivenByHand>> runs;
    for (const std::string& how : kHows)
      runs.push_back(std::make_unique<DrivenByHand>(Failure{kTeleop, behaviour, how}));
    const auto all_have_ended = [&] {
      return std::ranges::all_of(runs, [](const auto& run) { return run->ends_within(Seconds(0.02)); });
    };
    while (!all_have_ended())
      for (const auto& run : runs) run->press();
    for (std::size_t i = 0; i < runs.size(); ++i) {
      CAPTURE(behaviour, kHows[i]);
      const Run run = runs[i]->result();
      INFO(run.err);
      check_stops(run, {kTeleop, behaviour, kHows[i]}, DrivenByHand::kAt, kSanitized ? kSlowdown : 1.0);
    }
  }
}

TEST_CASE("a rehearsed failure is told as one, and a run without it has another trace", "[system][failure]") {
  const Words graph{source_file("graphs/scout_goto.xml"), "--until", "12 s"};
  const Run whole = run_deployer(graph + virtual_clock());
  const Run failing = run_deployer(graph + Words{"--fail", "avoid=silent@10s"} + virtual_clock());
  CHECK(failing.says("avoid: fails from now on, because --fail asks for it"));
  CHECK_FALSE(whole.says("--fail"));
  const Run too_late = run_deployer(graph + Words{"--fail", "avoid=silent@20s"} + virtual_clock());
  CHECK(too_late.says("the failure of avoid at 20 s did not come: the run ended after 12.00 s"));
  CHECK_FALSE(failing.says("did not come"));
  CHECK(failing.trace_hash() != whole.trace_hash());
  CHECK(failing.trace_hash() ==
        run_deployer(graph + Words{"--fail", "avoid=silent@10s"} + virtual_clock()).trace_hash());
}

TEST_CASE("unknown components that are to fail are reported with what else is wrong, by --check too",
          "[system][failure]") {
  const Words graph{source_file("graphs/scout_goto.xml"),
                    "--fail",
                    "avoi=silent@1s",
                    "--fail",
                    "nobody=hang@1s",
                    "--set",
                    "base.max_age=1",
                    "--until",
                    "1 s"};
  for (const Words& words : {graph, graph + Words{"--check"}}) {
    const Run run = run_deployer(words + virtual_clock());
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.out.empty());
    CHECK(run.says(
        "command line: error G016: --fail avoi: there is no component \"avoi\"; did you mean \"avoid\"?"));
    CHECK(run.says(
        "command line: error G016: --fail nobody: there is no component \"nobody\"; the graph has: "));
    CHECK(run.says("command line: error G029: component \"base\""));
    CHECK(split_lines(run.err).size() == 3);
  }
}

TEST_CASE("a component is to fail once only", "[system][failure]") {
  const Run run = run_deployer({source_file("graphs/scout_goto.xml"), "--fail", "avoid=slow@1s", "--fail",
                                "goto=hang@1s", "--fail", "avoid=hang@2s", "--check"});
  CHECK(run.exit_code() == 2);
  CHECK(run.says("--fail: \"avoid\" is to fail twice"));
}

TEST_CASE("a failure that cannot be rehearsed is refused, with what was expected", "[system][failure]") {
  const auto refused = [](const std::string& fault) {
    const Run run = run_deployer({source_file("graphs/scout_goto.xml"), "--fail", fault, "--until", "1 s"});
    CHECK(run.exit_code() == 2);
    return run.err;
  };
  CHECK_THAT(refused("avoi=silent@1s"),
             Catch::Contains("no component \"avoi\"") && Catch::Contains("\"avoid\""));
  CHECK_THAT(refused("avoid=dead@1s"), Catch::Contains("silent, throw, hang, slow"));
  CHECK_THAT(refused("avoid"), Catch::Contains("COMPONENT=HOW@TIME"));
  CHECK_THAT(refused("avoid=silent"), Catch::Contains("COMPONENT=HOW@TIME"));
  CHECK_THAT(refused("avoid=silent@1 parsec"), Catch::Contains("--fail: "));
}
