// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that knows nothing of a building makes its map, and then drives to goals in it.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "deployer.hpp"
#include "record_table.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr double kReach = 0.3;   // [m] that the robot may be off a goal by its true pose
constexpr double kPeriod = 0.1;  // [s] of the true pose

const std::map<std::string, std::pair<double, double>> kGoals{
    {"kitchen", {4.2, 9.8}}, {"office_2", {9.0, 2.0}}, {"meeting", {13.0, 10.4}}};

// Drives, and returns the names of the goals at which the robot said to be and truly was.
std::vector<std::string> goals_reached(const std::string& realism, int seed) {
  const TempFolder folder;
  const std::string poses = folder.file("poses.csv");
  const Run run =
      run_deployer(Words{system_graph("own_map.xml"), "--until", "450 s", "--seed", std::to_string(seed),
                         "--set", "realism=" + realism, "--record", poses + "=truth.RobotPosePush"} +
                       virtual_clock(),
                   Seconds(300));
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
  const auto truth = RecordTable(poses).rows("truth.RobotPosePush");
  std::vector<std::string> reached;
  for (const Arrival& arrival : run.arrivals()) {
    const auto [x, y] = kGoals.at(arrival.name);
    const auto& there = truth.at(static_cast<std::size_t>(std::lround(arrival.t / kPeriod)) - 1);
    CHECK(std::fabs(number(there, "stamp") - arrival.t) <= kPeriod);
    if (std::hypot(number(there, "x") - x, number(there, "y") - y) < kReach) reached.push_back(arrival.name);
  }
  return reached;
}

}  // namespace

TEST_CASE("from an empty map a robot reaches three goals in the map that it has made, and touches nothing",
          "[system][slam]") {
  const std::vector<std::string> all{"kitchen", "office_2", "meeting"};
  for (int seed = 1; seed <= (is_slow_run() ? 20 : 1); ++seed) {
    CAPTURE(seed);
    CHECK(goals_reached("nominal", seed) == all);
    if (is_slow_run()) CHECK(goals_reached("recorded", seed) == all);
  }
}
