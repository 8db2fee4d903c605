// SPDX-License-Identifier: GPL-3.0-or-later
// Sensors, localizers and behaviours that say nothing valid, between a robot and those who drive it.
#include <catch2/catch.hpp>
#include <cstdio>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

struct Driver {
  std::string profile;
  std::string avoid;  // the avoid behaviour, if the profile takes one
};

struct Lie {
  std::string line;
  double before = 0.0;  // [m/s]
  double after = 0.0;   // [m/s] the largest speed from half a second after its begin on
};

const std::vector<Driver> kDrivers{{"by_sonar", {}},
                                   {"by_laser", "orca.LaserAvoid"},
                                   {"by_laser", "orca.VfhPlus"},
                                   {"by_laser", "orca.NdPlus"},
                                   {"by_laser", "orca.Dwa"},
                                   {"by_laser", "orca.PotentialField"},
                                   {"planner", {}},
                                   {"walk", {}},
                                   {"gate", {}},
                                   {"wall", {}},
                                   {"alone", {}}};

Run run_liar(const Driver& driver, int lies, int seed) {
  Words words{system_graph("liar.xml"),       "--profile", driver.profile,      "--set",
              "lies=" + std::to_string(lies), "--seed",    std::to_string(seed)};
  if (!driver.avoid.empty()) words = words + Words{"--set", "avoid=" + driver.avoid};
  return run_deployer(words + with_test_plugins() + virtual_clock(), Seconds(600));
}

std::vector<Lie> lies_of(const Run& run) {
  std::vector<Lie> lies;
  for (const std::string& line : split_lines(run.err)) {
    const auto speeds = line.find(": ", line.find(" lie "));
    Lie lie{line};
    if (line.find(" lie ") == std::string::npos) continue;
    if (std::sscanf(line.c_str() + speeds, ": %lf m/s, then %lf m/s", &lie.before, &lie.after) == 2)
      lies.push_back(lie);
  }
  return lies;
}

void check_that_nonsense_stands(int lies, int seed) {
  for (const Driver& driver : kDrivers) {
    const Run run = run_liar(driver, lies, seed);
    INFO(driver.profile << " " << driver.avoid << "\n" << run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.contacts().empty());
    CHECK(run.says(" of \"liar\" counts as none: "));
    const std::vector<Lie> told = lies_of(run);
    CHECK(told.size() == static_cast<std::size_t>(lies));
    for (const Lie& lie : told) {
      INFO(lie.line);
      CHECK(lie.before >= 0.25);
      CHECK(lie.after <= 0.05);
    }
  }
}

}  // namespace

TEST_CASE(
    "half a second after the first wrong scan, pose or command the robot stands, the sender is named, and it "
    "drives on afterwards",
    "[system][nonsense]") {
  check_that_nonsense_stands(12, 1);
}

TEST_CASE("a robot that stands for good says why, in one line for each cause", "[system][nonsense]") {
  const auto says = [](const Driver& driver, const std::string& fault, const std::string& cause) {
    Words words{system_graph("liar.xml"), "--profile", driver.profile, "--set",
                "fault=" + fault,         "--until",   "13 s"};
    if (!driver.avoid.empty()) words = words + Words{"--set", "avoid=" + driver.avoid};
    const Run run = run_deployer(words + with_test_plugins() + virtual_clock());
    INFO(driver.profile << " " << driver.avoid << " " << fault << "\n" << run.err);
    CHECK(run.said(cause).size() == 1);
  };
  for (const Driver& driver : kDrivers) {
    if (driver.profile != "by_laser" && driver.profile != "planner") continue;
    if (driver.profile == "by_laser")
      says(driver, "posts",
           "the robot stands: of the laser \"liar\" 10 of its 181 beams, from -90 to -81 deg, end within the "
           "robot's own outline: it sees itself");
    says(driver, "covered",
         "the robot stands: of the laser \"liar\" 10 of its 181 beams, from -90 to -81 deg, are nearer than "
         "0.02 m: something is at the laser");
  }
  says({"by_laser", "orca.LaserAvoid"}, "backwards",
       "the robot stands: none of its lasers looks ahead; is the rpy of the laser's joint in the robot's "
       "file right?");
  says({"planner", {}}, "backwards",
       "the LaserRangeReadings of \"liar\" counts as none: none of its beams looks ahead");
  says({"by_sonar", {}}, "backwards",
       "the SonarRangeReadings of \"liar\" counts as none: none of its sonars looks ahead");
  says({"gate", {}}, "backwards", "alarm SENSOR_SILENT: the robot stands: none of its sensors looks ahead");
  says({"walk", {}}, "backwards",
       "the LaserRangeReadings of \"liar\" counts as none: none of its beams looks ahead");
  says({"by_sonar", {}}, "sonars_off",
       "the SonarRangeReadings of \"liar\" counts as none: no sonar has fired for ");
}

TEST_CASE("a hundred wrong scans, poses and commands, drawn by the seed, stop each behaviour",
          "[.][slow][system][nonsense]") {
  for (const int seed : {2, 3}) check_that_nonsense_stands(100, seed);
}
