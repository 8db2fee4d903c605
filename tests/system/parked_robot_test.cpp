// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that stands still costs the other robots of its world no reading.
#include <catch2/catch.hpp>

#include <map>
#include <sstream>
#include <utility>

#include "deployer.hpp"
#include "temp_folder.hpp"
#include "trace_file.hpp"

using namespace orca::test;

namespace {

constexpr double kSonarPeriod = 0.2;      // [s] of sim/robots/nomad_scout.urdf
constexpr double kOdometryPeriod = 0.05;  // [s]

/// The numbers of sonar and odometry readings that reached the walking robot's avoider.
using Readings = std::pair<long, long>;

// Returns how many objects a connection delivered, from the table of --stats.
long delivered(const Run& run, const std::string& connection) {
  for (const std::string& line : split_lines(run.err)) {
    const std::size_t at = line.find(connection + " ");
    if (at == std::string::npos) continue;
    long count = -1;
    std::istringstream(line.substr(at + connection.size())) >> count;
    return count;
  }
  FAIL("no row " << connection << " in:\n" << run.err);
  return -1;
}

std::string use(const std::string& part, const std::string& prefix) {
  return "  <use graph=\"" + source_file("tests/data/graphs/parts/" + part) + "\" prefix=\"" + prefix +
         "\"/>\n";
}

const std::string kWalker = use("walking_scout.xml", "walker");
const std::string kParked = use("parked_scout.xml", "parked");

Run run_for(const std::string& duration, const std::string& robots, const Words& how) {
  const TempFolder folder;
  const std::string graph = "<graph name=\"pair\" version=\"1\">\n" + robots + "</graph>\n";
  Run run =
      run_deployer(Words{folder.write("pair.xml", graph), "--until", duration, "--stats"} + how, Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return run;
}

Readings readings_of(const Run& run) {
  return {delivered(run, "walker/base.SonarRangeReadingsPush -> walker/avoid.sonar"),
          delivered(run, "walker/base.OdometryPush -> walker/avoid.odometry")};
}

Words executor(const std::string& clock, const std::string& name) {
  return {"--clock", clock, "--executor", name};
}

std::vector<Words> virtual_executors() {
  if (kThreadSanitizer) return {executor("virtual", "baton")};
  return {executor("virtual", "fiber"), executor("virtual", "baton")};
}

std::vector<Words> steady_executors() {
  if (kThreadSanitizer) return {executor("steady", "thread")};
  return {executor("steady", "thread"), executor("steady", "fiber"), executor("steady", "baton")};
}

}  // namespace

TEST_CASE("next to a parked robot a robot gets as many readings as alone, whichever the graph names first",
          "[system][several]") {
  for (const Words& how : virtual_executors()) {
    CAPTURE(how);
    const Readings alone = readings_of(run_for("10 s", kWalker, how));
    CHECK(static_cast<double>(alone.first) > 10.0 / kSonarPeriod - 3.0);
    CHECK(static_cast<double>(alone.second) > 10.0 / kOdometryPeriod - 3.0);
    const Run second = run_for("10 s", kParked + kWalker, how);
    const Run first = run_for("10 s", kWalker + kParked, how);
    CHECK(readings_of(second) == alone);
    CHECK(readings_of(first) == alone);
    CHECK(first.trace_hash() == second.trace_hash());
  }
}

TEST_CASE(
    "each of five robots receives its odometry at the end of each of its periods, neither later nor twice",
    "[system][several]") {
  const TempFolder folder;
  const Run run = run_deployer(
      Words{source_file("graphs/five_robots.xml"), "--until", "5 s", "--trace", folder.file("trace")} +
      virtual_clock());
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  std::map<std::string, int> received;
  const TraceFile trace(folder.file("trace"));
  for (const TraceLine& line : trace.lines()) {
    if (line.event != "deliver" || line.words[1] != "odometry") continue;
    CAPTURE(line.words[0]);
    CHECK(line.time == Approx(++received[line.words[0]] * kOdometryPeriod).margin(1e-6));
  }
  CHECK(received.size() == 5);
  for (const auto& [component, count] : received) CHECK(count >= 99);
}

// How many of them a busy machine lets through is not fixed: a world that has fallen behind does not catch up.
TEST_CASE("in real time, too, a robot next to a parked one gets most of its readings", "[system][several]") {
  for (const Words& how : steady_executors())
    for (const std::string& robots : {kParked + kWalker, kWalker + kParked}) {
      CAPTURE(how, robots);
      const auto [sonar, odometry] = readings_of(run_for("3 s", robots, how));
      CHECK(static_cast<double>(sonar) > 0.5 * 3.0 / kSonarPeriod);
      CHECK(static_cast<double>(odometry) > 0.5 * 3.0 / kOdometryPeriod);
    }
}
