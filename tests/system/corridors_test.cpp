// SPDX-License-Identifier: GPL-3.0-or-later
// Straight empty corridors of all widths: a wider one never takes longer.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <limits>

#include "deployer.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kFieldIsSteady = 1.1;  // [m]

struct Course {
  std::string avoider;
  std::string robot;
};

const Words kLaserAvoiders{"LaserAvoid", "VfhPlus", "Dwa", "NdPlus", "PotentialField", "GridPlanner"};
const Words kWithLaser{"pioneer_2dx", "pioneer_2dx_gripper", "barn_base", "peoplebot", "omni", "create2"};
const Words kWithSonars{"nomad_scout", "nomad_200", "nomad_xr4000", "pioneer_2dx", "peoplebot", "omni"};

std::string corridor(double width) {
  char text[400];
  std::snprintf(text, sizeof text,
                "<world name=\"corridor\" version=\"1\"><wall name=\"left\" from=\"-2 %.3f\" to=\"14 %.3f\"/>"
                "<wall name=\"right\" from=\"-2 -%.3f\" to=\"14 -%.3f\"/>"
                "<place name=\"start\" x=\"0\" y=\"0\" yaw=\"0\"/></world>",
                0.5 * width + 0.05, 0.5 * width + 0.05, 0.5 * width + 0.05, 0.5 * width + 0.05);
  return text;  // A wall is 0.1 m thick.
}

Words graph_of(const Course& course) {
  if (course.avoider == "SonarAvoid")
    return {source_file(course.robot == "peoplebot" ? "graphs/peoplebot.xml" : "graphs/scout_goto.xml")};
  if (course.avoider == "GridPlanner") return {source_file("graphs/pioneer_planner.xml")};
  return {source_file("graphs/pioneer_laser_goto.xml"), "--set", "avoid=orca." + course.avoider};
}

// Returns the time [s] in which the robot drives 10 m; infinity if it gives up, or takes more than 200 s.
double time_through(const TempFolder& folder, const Course& course, double width) {
  const Run run =
      run_deployer(graph_of(course) + virtual_clock() +
                       Words{"--set", "world=" + folder.write("corridor.xml", corridor(width)), "--set",
                             "robot=" + source_file("sim/robots/" + course.robot + ".urdf"), "--set",
                             "place=start", "--set", "goals=end: 10 0", "--until", "200 s"},
                   Seconds(60));
  INFO(run.err);
  if (run.says("would start inside")) return kNever;  // it is wider than the corridor
  REQUIRE(run.trace_hash());
  const auto contacts = run.contacts();
  if (!contacts.empty() && contacts.front().find(" 0.0") != std::string::npos)
    return kNever;  // it fills the corridor
  CHECK(contacts.empty());
  return run.arrivals().empty() ? kNever : run.arrivals()[0].t;
}

// Khatib's field sways between walls, more or less by chance: its page says so.
bool sways(const Course& course, double width) {
  return course.avoider == "PotentialField" && width < kFieldIsSteady;
}

// In corridors from `passes` [m] on the robot must arrive. The widths are in centimetres.
void check_widths(const Course& course, int step, double passes, int widest = 200) {
  const TempFolder folder;
  double least = kNever;
  std::cout << course.avoider << ' ' << course.robot << ':';
  for (int width = 60; width <= widest; width += step) {
    INFO(course.avoider << ' ' << course.robot << ", " << width << " cm");
    const double time = time_through(folder, course, 0.01 * width);
    std::cout << ' ' << width << '=' << time;
    const double growth = course.avoider == "PotentialField" ? 1.1 : 1.05;
    CHECK((least == kNever || time <= growth * least || sways(course, 0.01 * width)));
    CHECK((time < kNever || 0.01 * width < passes));
    least = std::min(least, time);
  }
  std::cout << '\n';
}

}  // namespace

TEST_CASE("no avoider takes longer for a wider corridor, nor touches its walls", "[system][corridors]") {
  const int coarse = is_slow_run() ? 1 : 2;
  check_widths({"LaserAvoid", "pioneer_2dx"}, 12 * coarse, 0.7);
  check_widths({"LaserAvoid", "omni"}, 14 * coarse, 0.7);
  check_widths({"SonarAvoid", "nomad_scout"}, 12 * coarse, 0.8);
  check_widths({"SonarAvoid", "peoplebot"}, 14 * coarse, 0.74);
  for (const char* const avoider : {"VfhPlus", "Dwa", "NdPlus", "GridPlanner"})
    check_widths({avoider, "pioneer_2dx"}, 28 * coarse, 0.9);
  check_widths({"GridPlanner", "barn_base"}, 2 * coarse, 0.6, 72);
  check_widths({"NdPlus", "create2"}, 4 * coarse, 0.7, 80);
  check_widths({"PotentialField", "barn_base"}, 28 * coarse, kFieldIsSteady);
}

TEST_CASE("no robot with any avoider takes longer for a corridor that is 2 cm wider", "[.][slow]") {
  for (const std::string& robot : kWithSonars) check_widths({"SonarAvoid", robot}, 2, 1.0);
  for (const std::string& avoider : kLaserAvoiders)
    for (const std::string& robot : kWithLaser)
      check_widths({avoider, robot}, 2, avoider == "PotentialField" ? kFieldIsSteady : 1.0);
}
