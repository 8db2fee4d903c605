// SPDX-License-Identifier: GPL-3.0-or-later
// The calibration of odometry: a mission that drives squares, and what its recording says of the wheels.
#include <catch2/catch.hpp>
#include <cmath>

#include "deployer.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kMission = source_file("graphs/calibrate.xml");
const std::string kRobot = source_file("sim/robots/pioneer_2dx.urdf");
constexpr double kTrack = 0.3571;  // [m] of that robot

// Some of the mission's squares, as many each way round.
const std::string kTwo =
    "corner: 0 0; start1: 1 0; ccw1: 4 0 > 4 4 > 0 4 > 0 0; start2: 0 1; cw1: 0 4 > 4 4 > 4 0 > 0 0";
const std::string kFour =
    "corner: 0 0; start1: 1 0; ccw1: 4 0 > 4 4 > 0 4 > 0 0; start2: 1 0; ccw2: 4 0 > 4 4 > 0 4 > 0 0; "
    "start3: 0 1; cw1: 0 4 "
    "> 4 4 > 4 0 > 0 0; start4: 0 1; cw2: 0 4 > 4 4 > 4 0 > 0 0";

// The odometry turns too much, by 2 % and by what a right wheel that is 1 % larger than the left one does.
constexpr double kTurnScale = 1.02;
constexpr double kTurnPerMetre = 0.01 / kTrack;

// Drives the squares with real drivers and ideal wheels; the driver's parameters are what makes its odometry wrong.
void drive(const std::string& recording, double turn_scale, double turn_per_metre, const Words& more = {}) {
  const Run run =
      run_deployer(Words{kMission, "--profile", "emulate", "--until", "1200 s", "--set", "realism=ideal",
                         "--set", "pioneer.turn_scale=" + std::to_string(turn_scale), "--set",
                         "pioneer.turn_per_metre=" + std::to_string(turn_per_metre), "--record", recording} +
                       virtual_clock() + more,
                   Seconds(120));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  CHECK(run.failures().empty());
}

// Returns a figure of the answer in JSON.
double figure(const std::string& json, const std::string& name, std::size_t which = 0) {
  std::size_t at = 0;
  for (std::size_t i = 0; i <= which; ++i) {
    at = json.find("\"figure\": \"" + name + "\"", at);
    REQUIRE(at != std::string::npos);
    ++at;
  }
  const std::string value = "\"value\": ";
  const std::size_t begin = json.find_first_not_of("\" ", json.find(value, at) + value.size());
  return std::stod(json.substr(begin, 20));
}

std::string calibrated(const std::string& recording) {
  const Run run =
      run_orcactl({"--json", "calibrate", recording, "--robot", kRobot, "--square", "4 m"}, Seconds(120));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return run.out;
}

}  // namespace

TEST_CASE("a mismatch of the wheels of 1 % and a track off by 2 % are found within 0.1 %",
          "[system][calibrate]") {
  const TempFolder folder;
  drive(folder.file("wrong.mcap"), kTurnScale, kTurnPerMetre,
        is_slow_run() ? Words{} : Words{"--set", "goals=" + kFour});
  const std::string found = calibrated(folder.file("wrong.mcap"));
  INFO(found);
  CHECK(std::fabs(figure(found, "distance_scale") - 1.0) < 0.001);
  CHECK(std::fabs(figure(found, "turn_scale") - 1.0 / kTurnScale) < 0.001);
  CHECK(std::fabs(figure(found, "track_ratio") - kTurnScale) < 0.001);
  CHECK(std::fabs(figure(found, "wheel_ratio") - 0.995 / 1.005) < 0.001);
  CHECK(figure(found, "squares") == (is_slow_run() ? 10 : 4));
  // The formulas for squares see the same, less well: the robot cuts their corners.
  CHECK(std::fabs(figure(found, "wheel_ratio", 1) - 0.995 / 1.005) < 0.002);
  CHECK(std::fabs(figure(found, "track_ratio", 1) - kTurnScale) < 0.005);
}

TEST_CASE("what calibrate finds corrects the odometry", "[.][slow]") {
  const TempFolder folder;
  drive(folder.file("wrong.mcap"), kTurnScale, kTurnPerMetre, {"--set", "goals=" + kFour});
  const std::string found = calibrated(folder.file("wrong.mcap"));
  const double turn = figure(found, "turn_scale");
  drive(folder.file("right.mcap"), turn * kTurnScale, turn * kTurnPerMetre + figure(found, "turn_per_metre"),
        {"--set", "goals=" + kTwo});
  const std::string left = calibrated(folder.file("right.mcap"));
  INFO(left);
  CHECK(figure(left, "squares") == 2);
  CHECK(figure(found, "error") > 1.0);
  CHECK(figure(left, "error") < 0.1 * figure(found, "error"));
}

TEST_CASE("calibrate prints lines for the graph and for the robot's file, and says what it needs",
          "[system][calibrate]") {
  const TempFolder folder;
  const std::string recording = folder.file("run.carmen");
  REQUIRE(
      run_deployer(Words{kMission, "--until", "150 s", "--record", recording} + virtual_clock(), Seconds(60))
          .exit_code() == 0);
  const Run run = run_orcactl({"calibrate", recording, "--robot", kRobot}, Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("<param name=\"distance_scale\" value=\"") &&
                          Contains("<param name=\"turn_per_metre\" value=\"") &&
                          Contains("<wheel_errors wheel_diameter=\""));
  CHECK_THAT(run_orcactl({"calibrate", recording}).err, Contains("name the robot's file: --robot "));
  CHECK(run_orcactl({"calibrate", recording}).exit_code() == 2);
  const std::string xr4000 = source_file("sim/robots/nomad_xr4000.urdf");
  CHECK_THAT(run_orcactl({"calibrate", recording, "--robot", xr4000}).err,
             Contains("not the file of a base with two driven wheels"));
  CHECK_THAT(run_orcactl({"calibrate", recording, "--robot", kRobot, "--square", "4 kg"}).err,
             Contains("--square: "));
  CHECK_THAT(run_orcactl({"calibrate", recording, "--robot", kRobot, "--square", "4 m"}, Seconds(60)).err,
             Contains("there are no squares both ways round in the recording"));
  CHECK_THAT(run_orcactl({"calibrate", recording, "laser.Scan", "--robot", kRobot}).err,
             Contains("nothing of \"laser.Scan\" is in the recording"));
  CHECK(run_orcactl({"calibrate", folder.file("none"), "--robot", kRobot}).exit_code() != 0);
}
