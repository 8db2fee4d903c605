// SPDX-License-Identifier: GPL-3.0-or-later
// What each component of each shipped graph is for: without it the run gets worse, in the way that the comment of the graph
// says. scout_teleop is in teleop_test.cpp, because it needs a person at the keys, scout_player in player_server_test.cpp, and emulated_devices, which
// are for other programs, in hwprobe_test.cpp. scout_goto_processes and two_machines are
// the same run as scout_goto, to which placement_test.cpp compares them, and scout_goto_two_localizers is in trading_test.cpp.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <map>
#include <regex>
#include <set>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

// A way to do without a component.
enum class How {
  silent,   // It is there and does nothing.
  crashed,  // Its first lap throws.
  removed,  // It is not in the graph, nor are its connections.
};

enum class Worse {
  contact,  // The robot touches something.
  nowhere,  // It reaches none of its goals.
  stands,   // It does not move.
  refused,  // The system does not start.
};

struct Case {
  std::string graph;
  std::string component;
  How how;
  Worse worse;
};

const std::vector<Case> kCases{
    {"scout_goto", "command", How::silent, Worse::stands},
    {"scout_goto", "goto", How::silent, Worse::nowhere},
    {"scout_goto", "avoid", How::removed, Worse::contact},
    {"scout_goto", "fuser", How::silent, Worse::stands},
    {"scout_goto", "base", How::silent, Worse::stands},
    {"scout_goto", "localizer", How::crashed, Worse::nowhere},

    {"scout_gallery", "command", How::silent, Worse::stands},
    {"scout_gallery", "goto", How::silent, Worse::nowhere},
    {"scout_gallery", "avoid", How::removed, Worse::contact},
    {"scout_gallery", "fuser", How::silent, Worse::stands},
    {"scout_gallery", "base", How::silent, Worse::stands},
    {"scout_gallery", "localizer", How::crashed, Worse::nowhere},
    {"scout_gallery", "places", How::removed, Worse::refused},

    {"scout_rounds", "command", How::silent, Worse::stands},
    {"scout_rounds", "goto", How::silent, Worse::nowhere},
    {"scout_rounds", "avoid", How::removed, Worse::contact},
    {"scout_rounds", "fuser", How::silent, Worse::stands},
    {"scout_rounds", "base", How::silent, Worse::stands},
    {"scout_rounds", "localizer", How::crashed, Worse::nowhere},

    {"scout_odometry", "command", How::silent, Worse::stands},
    {"scout_odometry", "goto", How::silent, Worse::nowhere},
    {"scout_odometry", "avoid", How::removed, Worse::contact},
    {"scout_odometry", "fuser", How::silent, Worse::stands},
    {"scout_odometry", "base", How::silent, Worse::stands},

    {"scout_hospital", "command", How::silent, Worse::stands},
    {"scout_hospital", "goto", How::silent, Worse::nowhere},
    {"scout_hospital", "avoid", How::removed, Worse::contact},
    {"scout_hospital", "fuser", How::silent, Worse::stands},
    {"scout_hospital", "base", How::silent, Worse::stands},
    {"scout_hospital", "localizer", How::crashed, Worse::nowhere},

    {"pioneer_planner", "command", How::silent, Worse::stands},
    {"pioneer_planner", "planner", How::silent, Worse::nowhere},
    {"pioneer_planner", "fuser", How::silent, Worse::stands},
    {"pioneer_planner", "base", How::silent, Worse::stands},
    {"pioneer_planner", "laser", How::crashed, Worse::nowhere},
    {"pioneer_planner", "localizer", How::crashed, Worse::nowhere},

    {"pioneer_laser_goto", "command", How::silent, Worse::stands},
    {"pioneer_laser_goto", "goto", How::silent, Worse::nowhere},
    {"pioneer_laser_goto", "avoid", How::removed, Worse::contact},
    {"pioneer_laser_goto", "fuser", How::silent, Worse::stands},
    {"pioneer_laser_goto", "base", How::silent, Worse::stands},
    {"pioneer_laser_goto", "laser", How::crashed, Worse::nowhere},
    {"pioneer_laser_goto", "localizer", How::crashed, Worse::nowhere},

    {"courier_depot", "command", How::silent, Worse::stands},
    {"courier_depot", "goto", How::silent, Worse::nowhere},
    {"courier_depot", "avoid", How::removed, Worse::contact},
    {"courier_depot", "fuser", How::silent, Worse::stands},
    {"courier_depot", "base", How::silent, Worse::stands},
    {"courier_depot", "lasers", How::crashed, Worse::nowhere},
    {"courier_depot", "localizer", How::crashed, Worse::nowhere},

    {"nomad_xr4000", "command", How::silent, Worse::stands},
    {"nomad_xr4000", "goto", How::silent, Worse::nowhere},
    {"nomad_xr4000", "avoid", How::removed, Worse::nowhere},  // its gate keeps it off the walls
    {"nomad_xr4000", "fuser", How::silent, Worse::stands},
    {"nomad_xr4000", "gate", How::silent, Worse::stands},
    {"nomad_xr4000", "base", How::silent, Worse::stands},
    {"nomad_xr4000", "localizer", How::crashed, Worse::nowhere},

    {"nomad_200", "command", How::silent, Worse::stands},
    {"nomad_200", "goto", How::silent, Worse::nowhere},
    {"nomad_200", "avoid", How::removed, Worse::contact},
    {"nomad_200", "fuser", How::silent, Worse::stands},
    {"nomad_200", "turret", How::removed, Worse::contact},
    {"nomad_200", "base", How::silent, Worse::stands},
    {"nomad_200", "localizer", How::crashed, Worse::nowhere},

    {"pioneer_fetch", "command", How::silent, Worse::stands},
    {"pioneer_fetch", "porter", How::silent, Worse::stands},
    {"pioneer_fetch", "goto", How::silent, Worse::nowhere},
    {"pioneer_fetch", "avoid", How::removed, Worse::nowhere},  // its gate keeps it off the column
    {"pioneer_fetch", "fuser", How::silent, Worse::stands},
    {"pioneer_fetch", "gate", How::silent, Worse::stands},
    {"pioneer_fetch", "base", How::silent, Worse::stands},
    {"pioneer_fetch", "laser", How::crashed, Worse::nowhere},
    {"pioneer_fetch", "localizer", How::crashed, Worse::nowhere},

    {"random_walk", "walk", How::silent, Worse::stands},
    {"random_walk", "avoid", How::removed, Worse::contact},
    {"random_walk", "fuser", How::silent, Worse::stands},
    {"random_walk", "base", How::silent, Worse::stands},
};

// Shipped graphs with goals that the robot cannot reach, or not surely.
const std::set<std::string> kLeavesGoals{"scout_rounds", "scout_odometry"};

// Shipped graphs that other tests look at.
const std::set<std::string> kElsewhere{"emulated_devices",
                                       "scout_teleop",
                                       "scout_player",
                                       "scout_goto_processes",
                                       "scout_goto_two_localizers",
                                       "two_machines",
                                       "warehouse_scanner",
                                       "scout_real_time",
                                       "scout_from_afar",
                                       "scout_behaviours",
                                       "replay",
                                       "ros2_pioneer",  // ros2_test
                                       "ros2_robot",
                                       "team_robot",  // team_test
                                       "intel_log",
                                       "localize_log",
                                       "calibrate",
                                       "pioneer_localize",
                                       "pioneer_people",
                                       "pioneer_follow",
                                       "camera",  // follow_test
                                       "scout_wall",
                                       "pioneer_tasks",
                                       "pioneer_roam",  // rights_test
                                       "pioneer_fetch_task",
                                       "pioneer_planner_parts",
                                       "pioneer_slam",
                                       "pioneer_map",
                                       "scout_localize",
                                       "scout_tasks"};

// Graphs of robots that exist, and those whose components they have, one for one.
const std::map<std::string, std::string> kOfRealRobots{{"nomad_scout", "scout_goto"},
                                                       {"peoplebot", "scout_goto"},
                                                       {"pioneer2dx_sick", "pioneer_laser_goto"},
                                                       {"pioneer_one_core", "pioneer_laser_goto"},
                                                       {"player_robot", "pioneer_laser_goto"},
                                                       {"create2_rplidar", "pioneer_laser_goto"}};

// Shipped graphs of several robots, and of how many. Each robot has the components of scout_goto under its own prefix.
const std::map<std::string, std::size_t> kOfSeveral{{"two_robots", 2}, {"five_robots", 5}};

// Returns the names of all components of a shipped graph in its default profile.
std::vector<std::string> components_of(const std::string& graph) {
  const std::string text = printed(graph);
  const std::regex declaration("<component name=\"([^\"]+)\"");
  std::vector<std::string> names;
  for (std::sregex_iterator found(text.begin(), text.end(), declaration), end; found != end; ++found)
    names.push_back((*found)[1]);
  return names;
}

Run run(const ShippedGraph& graph, const std::string& name, const Words& more, const char* until = "200 s") {
  const TempFolder folder;
  return run_deployer(Words{folder.write(name + ".xml", graph.text()), "--until", until} +
                      needed_arguments(name, folder) + virtual_clock() + more);
}

bool moves(const Run& run) { return run.says("watch: moves after"); }

Run run_without(const Case& c) {
  ShippedGraph graph(c.graph);
  graph.watch_motion("base");
  if (c.how == How::removed) graph.remove(c.component);
  Words more;
  if (c.how == How::silent) more = {"--fail", c.component + "=silent@0s"};
  if (c.how == How::crashed) more = {"--fail", c.component + "=throw@0s"};
  return run(graph, c.graph, more, c.worse == Worse::stands && !is_slow_run() ? "20 s" : "200 s");
}

void check_worse(const Run& run, Worse worse) {
  if (worse == Worse::contact) CHECK_FALSE(run.contacts().empty());
  if (worse != Worse::contact) CHECK(run.arrivals().empty());
  if (worse == Worse::stands || worse == Worse::refused) CHECK_FALSE(moves(run));
}

// Returns how many goals a robot reached, given the prefix of its components.
long arrivals_of(const std::string& prefix, const Run& run) {
  const std::string robot = static_cast<char>(std::toupper(prefix[0])) + prefix.substr(1);
  const std::vector<Arrival> all = run.arrivals();
  return std::count_if(all.begin(), all.end(),
                       [&](const Arrival& arrival) { return arrival.robot == robot; });
}

}  // namespace

TEST_CASE("every component of every shipped graph has its case", "[system][ablation]") {
  std::set<std::string> missing;
  for (const std::string& graph : shipped_graphs())
    for (const std::string& component : components_of(graph))
      if (!kElsewhere.contains(graph) && !kOfSeveral.contains(graph) && !kOfRealRobots.contains(graph))
        missing.insert(graph + "." + component);
  for (const Case& c : kCases) CHECK(missing.erase(c.graph + "." + c.component) == 1);
  CHECK(missing.empty());
}

TEST_CASE("graphs of robots that exist have the components of a graph whose components all count, and arrive",
          "[system][ablation]") {
  for (const auto& [graph, original] : kOfRealRobots) {
    CAPTURE(graph);
    CHECK(components_of(graph) == components_of(original));
    const Run run = run_deployer(Words{source_file("graphs/" + graph + ".xml")} + virtual_clock());
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.arrivals().size() == 3);
    CHECK(run.contacts().empty());
  }
}

TEST_CASE("where several robots drive, the one that lacks a component reaches fewer of its goals",
          "[system][ablation]") {
  for (const auto& [graph, robots] : kOfSeveral) {
    const std::vector<std::string> components = components_of(graph);
    const Run whole = run_deployer(Words{source_file("graphs/" + graph + ".xml")} + virtual_clock());
    CHECK(components.size() == 6 * robots);
    for (const std::string& component : components) {
      const std::string prefix = component.substr(0, component.find('/'));
      if (prefix != "dewey" && prefix != "daisy" && !is_slow_run()) continue;
      const bool serves_sensor = component.ends_with("/localizer");
      CAPTURE(graph, component);
      const Run run = run_deployer(Words{source_file("graphs/" + graph + ".xml"), "--until", "60 s", "--fail",
                                         component + (serves_sensor ? "=throw@0s" : "=silent@0s")} +
                                   virtual_clock());
      INFO(run.err);
      CHECK(run.ended);
      CHECK(arrivals_of(prefix, run) < arrivals_of(prefix, whole));
    }
  }
}

TEST_CASE("with all its components each shipped graph drives, arrives and touches nothing",
          "[system][ablation]") {
  std::set<std::string> graphs;
  for (const Case& c : kCases) graphs.insert(c.graph);
  for (const std::string& name : graphs) {
    ShippedGraph graph(name);
    graph.watch_motion("base");
    const Run whole = run(graph, name, {});
    CAPTURE(name);
    INFO(whole.err);
    CHECK(whole.exit_code() == (kLeavesGoals.contains(name) ? 1 : 0));
    CHECK(whole.contacts().empty());
    CHECK(moves(whole));
    CHECK(whole.arrivals().empty() == (name == "random_walk"));
  }
}

TEST_CASE("without any one of its components the run of a shipped graph gets worse", "[system][ablation]") {
  for (const Case& c : kCases) {
    CAPTURE(c.graph, c.component);
    const Run run = run_without(c);
    INFO(run.err);
    CHECK(run.ended);
    CHECK((run.exit_code() == 2) == (c.worse == Worse::refused));
    check_worse(run, c.worse);
  }
}
