// SPDX-License-Identifier: GPL-3.0-or-later
// A robot without a map drives to its goals by the map that it makes on the way.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "deployer.hpp"

using namespace orca::test;

namespace {

const std::map<std::string, std::pair<double, double>> kGoals{
    {"kitchen", {4.2, 9.8}}, {"office_2", {9.0, 2.0}}, {"meeting", {13.0, 10.4}}};

Run drive(const std::string& graph, const std::string& pose, const Words& more) {
  return run_deployer(Words{source_file("graphs/" + graph + ".xml"), "--profile", "sim", "--profile", pose} +
                          virtual_clock() + more,
                      Seconds(120));
}

// The goals at which the robot says it is, and where the simulator does not object.
int right_arrivals(const Run& run) {
  int right = 0;
  for (const Arrival& arrival : run.arrivals()) {
    const auto [x, y] = kGoals.at(arrival.name);
    right += std::hypot(arrival.x - x, arrival.y - y) < 0.3 ? 1 : 0;
  }
  return right;
}

}  // namespace

TEST_CASE("a robot with drifting wheels reaches its goals by the map that it makes", "[system][slam]") {
  for (const char* const graph : {"pioneer_planner", "pioneer_laser_goto"}) {
    const Run run = drive(graph, "slam", {"--set", "realism=harsh", "--seed", "3", "--until", "200 s"});
    INFO(graph << '\n' << run.err);
    CHECK(right_arrivals(run) == 3);
    CHECK(run.contacts().empty());
    CHECK(run.err.empty());
  }
  CHECK(right_arrivals(drive("pioneer_planner", "odometry",
                             {"--set", "realism=harsh", "--seed", "3", "--until", "200 s"})) < 3);
}

TEST_CASE("a map that is made comes out the same on both executors", "[system][slam]") {
  const auto hash = [](const std::string& executor) {
    const Run run = drive("pioneer_planner", "slam", {"--executor", executor, "--until", "40 s"});
    INFO(run.err);
    REQUIRE(run.trace_hash());
    return *run.trace_hash();
  };
  CHECK(hash("fiber") == hash("baton"));
}
