// SPDX-License-Identifier: GPL-3.0-or-later
// Whole systems with robots of other kinds than the Scout.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <regex>

#include "deployer.hpp"
#include "orca/geometry/angle.hpp"
#include "record_table.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using orca::wrapped;

namespace {

std::string robot_arg(const std::string& robot) {
  return "robot=" + source_file("sim/robots/" + robot + ".urdf");
}

// The shipped robot, without what its file says of how it is steered and how wrong its wheels are.
std::string without_figures(const std::string& robot) {
  const std::string text = read_text(source_file("sim/robots/" + robot + ".urdf"));
  return std::regex_replace(text, std::regex("steer_gain=\"[^\"]*\"|<wheel_errors[^>]*>"), "");
}

// Returns where the robot faced at a time.
double facing_at(const RecordTable& poses, double time) {
  for (const auto& row : poses.rows("localizer.RobotPosePush"))
    if (number(row, "stamp") >= time - 1e-6) return number(row, "orientation");
  return std::numeric_limits<double>::quiet_NaN();
}

// Returns how often a turret has gone past what is behind the robot.
double rounds(const RecordTable& turret) {
  double rounds = 0.0;
  double last = 0.0;
  for (const auto& row : turret.rows("base.TurretAnglePush")) {
    const double angle = number(row, "angle");
    if (last > 2.0 && angle < -2.0) ++rounds;
    last = angle;
  }
  return rounds;
}

}  // namespace

TEST_CASE(
    "a robot whose file does not say how to steer it and how wrong its wheels are is as quick, and hears "
    "once what is taken",
    "[system][robots]") {
  // It drives by odometry, and must be sure that it is there.
  const Words graph =
      Words{source_file("graphs/scout_goto_two_localizers.xml")} + virtual_clock() + Words{"--set"};
  const Run shipped = run_deployer(graph + Words{robot_arg("nomad_scout")});
  const TempFolder folder;
  const Run run =
      run_deployer(graph + Words{"robot=" + folder.write("r.urdf", without_figures("nomad_scout"))});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 1);
  REQUIRE(shipped.arrivals().size() == 1);
  CHECK(run.arrivals()[0].t == Approx(shipped.arrivals()[0].t).margin(0.1));
  CHECK(
      run.says("the file says no steer_gain and wheel_errors of this robot; the usual ones are "
               "taken: <drive ... steer_gain=\"2\"> and in <odometry> <wheel_errors "
               "wheel_diameter=\"0.204 %\" track=\"0.58 %\" slip=\"3 mm\" turn_slip=\"3 mm\"/>"));
  CHECK(run.err.find("G057") == run.err.rfind("G057"));
  CHECK_FALSE(shipped.says("G057"));
}

TEST_CASE("a synchro base with a turret and a holonomic base drive the run of the thesis",
          "[system][robots]") {
  for (const char* robot : {"nomad_200", "omni"}) {
    const Run run = run_deployer(Words{source_file("graphs/scout_goto.xml"), "--set", robot_arg(robot)} +
                                 virtual_clock());
    CAPTURE(robot, run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.arrivals().size() == 3);
    CHECK(run.contacts().empty());
  }
}

TEST_CASE("a robot passes by infrared the boxes that lie below its sonars", "[system][robots]") {
  const Run run = run_deployer(Words{source_file("graphs/nomad_200.xml")} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 3);
  CHECK(run.contacts().empty());

  std::string by_sonar = ShippedGraph("nomad_200").text();
  by_sonar = std::regex_replace(by_sonar, std::regex("orca\\.InfraredAvoid"), "orca.SonarAvoid");
  by_sonar =
      std::regex_replace(by_sonar, std::regex("base\\.InfraredRangeReadingsPush\" to=\"avoid\\.infrared"),
                         "base.SonarRangeReadingsPush\" to=\"avoid.sonar");
  const TempFolder folder;
  const Run deaf = run_deployer(Words{folder.write("by_sonar.xml", by_sonar)} + virtual_clock());
  INFO(deaf.err);
  CHECK_FALSE(deaf.contacts().empty());
}

TEST_CASE(
    "a robot passes thin stands while its turret goes round, and touches one while the turret points ahead",
    "[system][robots]") {
  const Words graph = Words{source_file("graphs/nomad_200.xml")} + virtual_clock();
  const TempFolder folder;
  for (const char* seed : {"2", "3"}) {
    const Run round = run_deployer(
        graph + Words{"--seed", seed, "--record", folder.file("turret.csv") + "=base.TurretAnglePush"});
    CAPTURE(seed, round.err);
    CHECK(round.exit_code() == 0);
    CHECK(round.arrivals().size() == 3);
    CHECK(round.contacts().empty());
    CHECK(rounds(RecordTable(folder.file("turret.csv"))) > round.arrivals()[2].t / 10.0);

    const Run ahead = run_deployer(graph + Words{"--seed", seed, "--set", "turret.lead=0 deg"});
    CAPTURE(ahead.err);
    CHECK_FALSE(ahead.contacts().empty());
  }
}

TEST_CASE("the turret of a robot that comes to rest turns to where the robot faces", "[system][robots]") {
  constexpr double kHeld = 10.0;   // [s]
  constexpr double kTurned = 4.0;  // [s] to come to rest and turn half round
  const TempFolder folder;
  const Run run =
      run_deployer(Words{source_file("graphs/nomad_200.xml"), "--fail", "fuser=silent@10s", "--until", "20s",
                         "--record", folder.file("turret.csv") + "=base.TurretAnglePush"} +
                   virtual_clock());
  INFO(run.err);
  CHECK(run.ended);
  double farthest_before = 0.0;
  double farthest_after = 0.0;
  for (const auto& row : RecordTable(folder.file("turret.csv")).rows("base.TurretAnglePush")) {
    double& farthest = number(row, "stamp") < kHeld ? farthest_before : farthest_after;
    if (number(row, "stamp") < kHeld || number(row, "stamp") > kHeld + kTurned)
      farthest = std::max(farthest, std::abs(number(row, "angle")));
  }
  CHECK(farthest_before > 3.0);
  CHECK(farthest_after < 0.01);
}

TEST_CASE("a graph that turns the turret of a robot without one is refused before anything runs",
          "[system][robots]") {
  std::string robot = read_text(source_file("sim/robots/nomad_200.urdf"));
  robot = std::regex_replace(robot, std::regex("<turret [^>]*>"), "");
  robot = std::regex_replace(robot, std::regex("type=\"continuous\""), "type=\"fixed\"");
  const TempFolder folder;
  const Run run = run_deployer({source_file("graphs/nomad_200.xml"), "--check", "--set",
                                "robot=" + folder.write("no_turret.urdf", robot)});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("TurretCommandSend"));
  CHECK(run.says("TurretAnglePush"));
}

TEST_CASE("a holonomic base moves sideways on command", "[system][robots]") {
  const Run run = run_deployer(Words{system_graph("sidestep.xml")} + with_test_plugins() + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
}

TEST_CASE("a graph that wants other bases to move sideways is refused before anything runs",
          "[system][robots]") {
  for (const char* robot : {"nomad_200", "nomad_scout", "barn_base"}) {
    const Run run = run_deployer(Words{system_graph("sidestep.xml"), "--set", robot_arg(robot)} +
                                 with_test_plugins() + virtual_clock());
    CAPTURE(robot, run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.says("HolonomicVelocitySend"));
    CHECK(run.says("MotionCommandSend"));
  }
}

TEST_CASE(
    "an XR4000 that Goto may move sideways is at its goals, and looks where they ask, in a fifth less time",
    "[system][robots]") {
  constexpr std::array kWanted{std::numbers::pi, 0.5 * std::numbers::pi, 0.0};  // as the graph's goals
  constexpr double kReachAngle = 0.1;                                           // [rad] Command's
  constexpr double kRounded = 0.01;
  const TempFolder folder;
  const std::string slides = ShippedGraph("nomad_xr4000").text();
  const std::string turns = std::regex_replace(slides, std::regex("<connect from=\"goto.robot\"[^>]*>"), "");
  REQUIRE(turns != slides);
  for (const char* seed : {"1", "2"}) {
    std::vector<double> times;
    for (const std::string& graph : {slides, turns}) {
      const Run run = run_deployer(Words{folder.write("graph.xml", graph), "--seed", seed, "--record",
                                         folder.file("poses.csv") + "=localizer.RobotPosePush"} +
                                   virtual_clock());
      CAPTURE(seed, run.err);
      CHECK(run.exit_code() == 0);
      CHECK(run.contacts().empty());
      REQUIRE(run.arrivals().size() == 3);
      times.push_back(run.arrivals()[2].t);
      const RecordTable poses(folder.file("poses.csv"));
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(std::abs(wrapped(facing_at(poses, run.arrivals()[i].t) - kWanted[i])) < kReachAngle + kRounded);
    }
    CHECK(times[0] < 0.8 * times[1]);
  }
}
