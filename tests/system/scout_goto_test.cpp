// SPDX-License-Identifier: GPL-3.0-or-later
// The thesis's run (11.1-11.2) in virtual time, seen from outside.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "deployer.hpp"
#include "temp_folder.hpp"
#include "trace_file.hpp"

using namespace orca::test;

namespace {

// The rooms of sim/worlds/office.xml: three on either side of a corridor between y = 5 m and y = 7 m.
std::string room_at(double x, double y) {
  if (y >= 5.0 && y <= 7.0) return "corridor";
  return std::string(y < 5.0 ? "south " : "north ") + std::to_string(static_cast<int>(x / 6.0));
}

std::set<std::string> rooms_of(const std::vector<Arrival>& arrivals) {
  std::set<std::string> rooms;
  for (const Arrival& arrival : arrivals) rooms.insert(room_at(arrival.x, arrival.y));
  return rooms;
}

Run drive(const Words& more = {}) {
  return run_deployer(Words{source_file("graphs/scout_goto.xml")} + virtual_clock() + more);
}

}  // namespace

TEST_CASE("the Scout drives to three goals in different rooms and touches nothing", "[system][scout]") {
  const Run run = drive();
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK(run.exit_code() == 0);
  const std::vector<Arrival> arrivals = run.arrivals();
  REQUIRE(arrivals.size() == 3);
  const std::set<std::string> rooms = rooms_of(arrivals);
  CHECK(rooms.size() == 3);
  CHECK_FALSE(rooms.contains("corridor"));
  CHECK(run.contacts().empty());
}

TEST_CASE("a Scout that is told to drive faster than it can touches nothing", "[system][scout]") {
  for (const char* seed : {"1", "4", "6"}) {
    const Run run = drive({"--set", "goto.max_speed=3", "--seed", seed});
    INFO(seed << run.err);
    CHECK(run.arrivals().size() == 3);
    CHECK(run.contacts().empty());
  }
}

TEST_CASE("stdout has a line per arrival, then the trace hash, and nothing else", "[system][scout]") {
  const Run run = drive();
  INFO(run.out);
  CHECK(run.trace_hash().has_value());
  CHECK(run.lines().size() == run.arrivals().size() + 1);
}

TEST_CASE("arrivals have names of their own and come one after the other, within two minutes",
          "[system][scout]") {
  const std::vector<Arrival> arrivals = drive().arrivals();
  REQUIRE(arrivals.size() == 3);
  std::set<std::string> names;
  for (const Arrival& arrival : arrivals) names.insert(arrival.name);
  CHECK(names.size() == 3);
  CHECK(std::ranges::is_sorted(arrivals, {}, &Arrival::t));
  CHECK(arrivals.front().t > 1.0);
  CHECK(arrivals.back().t < 120.0);
}

TEST_CASE("goals can be chosen on the command line, and only goals count as arrivals, not via points",
          "[system][scout]") {
  const Run run = drive({"--set", "goals=near: 2 6 > 3 6; far: 4 6"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const std::vector<Arrival> arrivals = run.arrivals();
  REQUIRE(arrivals.size() == 2);
  CHECK(arrivals[0].name == "near");
  CHECK(arrivals[1].name == "far");
  CHECK(std::hypot(arrivals[0].x - 3.0, arrivals[0].y - 6.0) < 0.25);
  CHECK(std::hypot(arrivals[1].x - 4.0, arrivals[1].y - 6.0) < 0.25);
}

TEST_CASE("without --seed a run has seed 1", "[system][scout]") {
  const Words harsh{"--until", "3 s", "--set", "realism=harsh"};
  const Run unnamed = drive(harsh);
  REQUIRE(unnamed.trace_hash().has_value());
  CHECK(unnamed.trace_hash() == drive(harsh + Words{"--seed", "1"}).trace_hash());
  CHECK(unnamed.trace_hash() != drive(harsh + Words{"--seed", "2"}).trace_hash());
}

TEST_CASE("--until ends a run early with exit 0 and a trace hash", "[system][scout]") {
  const Run run = drive({"--until", "2 s"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().empty());
  CHECK(run.trace_hash().has_value());
}

TEST_CASE("--until stops the robot at that time: no sensor reading is delivered later", "[system][scout]") {
  const TempFolder folder;
  REQUIRE(drive({"--until", "2 s", "--trace", folder.file("trace")}).exit_code() == 0);
  const TraceFile trace(folder.file("trace"));
  REQUIRE(trace.has("deliver", {"avoid", "sonar"}));
  double last = 0.0;
  for (const TraceLine& line : trace.lines())
    if (line.is("deliver", {"avoid", "sonar"})) last = line.time;
  CHECK(last > 1.5);
  CHECK(last <= 2.0);
}

TEST_CASE("without goals the command asks for them one after the other, until an empty line",
          "[system][scout]") {
  Subprocess program(
      deployer(Words{source_file("graphs/scout_goto.xml"), "--set", "goals="} + virtual_clock()),
      {.input = "ahead: 2 6\nnonsense 1\nnowhere\nfurther: 2.5 6 > 3 6\n\n"});
  const Run run = finish(program, Seconds(30));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const std::vector<Arrival> arrivals = run.arrivals();
  REQUIRE(arrivals.size() == 2);
  CHECK(arrivals[0].name == "ahead");
  CHECK(arrivals[1].name == "further");
  CHECK(run.says("cannot read the goal \"nonsense 1\""));
  CHECK(run.says("\"nowhere\" is the name of a place, and nobody says where it is"));
}

TEST_CASE("--picture draws what happened, as SVG and as PNG", "[system][scout]") {
  const TempFolder folder;
  CHECK(drive({"--until", "5s", "--picture", folder.file("run.svg")}).exit_code() == 0);
  CHECK(drive({"--until", "5s", "--picture", folder.file("run.png")}).exit_code() == 0);
  CHECK(read_text(folder.file("run.svg")).find("<svg") != std::string::npos);
  CHECK(read_text(folder.file("run.png")).starts_with("\x89PNG\r\n"));
}

TEST_CASE("at harsh realism the Scout passes its doors, with seeds that once made it drive to and fro at one",
          "[system][scout]") {
  for (const char* seed : {"5", "18", "31", "32", "39", "40"}) {
    const Run run = drive({"--set", "realism=harsh", "--seed", seed});
    INFO(run.err);
    CAPTURE(seed);
    CHECK(run.exit_code() == 0);
    CHECK(run.contacts().empty());
    REQUIRE(run.arrivals().size() == 3);
    CHECK(run.arrivals().back().t < 120.0);
  }
}

#if defined(ORCA_OPTIMISED)
// Of processor time, so that what the machine does besides is not in it.
TEST_CASE("a virtual run takes less than a fiftieth of its simulated time", "[system][scout]") {
  double best = 1e9;
  double simulated = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Run run = drive();
    REQUIRE(run.arrivals().size() == 3);
    simulated = run.arrivals().back().t;
    best = std::min(best, run.ending.cpu.count());
  }
  CAPTURE(simulated, best);
  CHECK(best < simulated / 50.0);
}
#endif
