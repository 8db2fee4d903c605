// SPDX-License-Identifier: GPL-3.0-or-later
// A robot without a map drives to its goals by the map that it makes on the way; with one, it does so all day.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "deployer.hpp"
#include "public_data.hpp"
#include "record_table.hpp"
#include "temp_folder.hpp"

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

// Somewhere to drive twice around.
struct Tour {
  Words floor;  // what the graph is told
  std::string goals;
  std::size_t count;
  double bar;  // [m]
};

Tour office() {
  const std::string there =
      "kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8; office_2: 3.6 7.6 > 3.6 6 > 9 6 > 9 4.4 > 9 2; meeting: 9 4.4 > 9 "
      "6 > "
      "14.4 6 > 14.4 7.6 > 13 10.4";
  return {{"--set", "world=" + source_file("sim/worlds/office.xml"), "--set", "x=1 m", "--set", "y=6 m"},
          there + "; back: 14.4 7.6 > 14.4 6 > 3.6 6 > 2 6; " + there,
          7,
          0.05};
}

Tour hospital(const std::string& map) {
  return {{"--set", "world=" + map, "--set", "map_width=140 m", "--set", "x=30 m", "--set", "y=13.5 m"},
          "corridor: 47 13.5; north: 61.5 13.5 > 61.5 27; back: 61.5 13.5 > 30 13.5; again: 47 13.5 > 61.5 "
          "13.5 > "
          "61.5 27; end: 61.5 13.5 > 30 13.5",
          5,
          0.10};
}

// How far the poses of a run are from the true ones [m], root of the mean square: as they are, and with the map laid where it fits
// best, since which way is ahead at the start is known no better than its first scans say.
struct PoseError {
  double plain = 0.0;
  double laid = 0.0;
};

using Place = std::complex<double>;

// The true place, and that by which the robot drives, at the times of the latter.
struct Pair {
  double time = 0.0;  // [s]
  Place by_map;
  Place truth;
};

std::vector<Pair> pairs_of(const RecordTable& table) {
  std::map<double, Place> truth;
  for (const RecordTable::Row& row : table.rows("truth.RobotPosePush"))
    truth[number(row, "stamp")] = {number(row, "x"), number(row, "y")};
  std::vector<Pair> pairs;
  for (const RecordTable::Row& row : table.rows("localizer.RobotPosePush")) {
    if (number(row, "covariance[0]") > 1e9) continue;  // It does not know.
    const double time = number(row, "stamp");
    const auto after = truth.lower_bound(time);
    if (after == truth.begin() || after == truth.end()) continue;
    const auto before = std::prev(after);
    const double share = (time - before->first) / (after->first - before->first);
    pairs.push_back({time,
                     {number(row, "x"), number(row, "y")},
                     before->second + share * (after->second - before->second)});
  }
  REQUIRE(pairs.size() > 500);
  return pairs;
}

PoseError error_of(const std::vector<Pair>& pairs) {
  const auto count = static_cast<double>(pairs.size());
  PoseError error;
  Place middle;
  Place true_middle;
  for (const Pair& pair : pairs) {
    error.plain += std::norm(pair.by_map - pair.truth) / count;
    middle += pair.by_map / count;
    true_middle += pair.truth / count;
  }
  std::complex<double> turn;  // best in the sense of least squares
  for (const Pair& pair : pairs) turn += (pair.truth - true_middle) * std::conj(pair.by_map - middle);
  turn /= std::abs(turn);
  for (const Pair& pair : pairs)
    error.laid += std::norm(turn * (pair.by_map - middle) - (pair.truth - true_middle)) / count;
  return {std::sqrt(error.plain), std::sqrt(error.laid)};
}

// Drives a tour and checks that it comes to its end, touching nothing.
PoseError error_on(const Tour& tour, const std::string& level, int seed) {
  const TempFolder folder;
  const std::string file = folder.file("poses.csv");
  const Run run = run_deployer(
      Words{source_file("tests/data/graphs/system/slam_drive.xml"), "--seed", std::to_string(seed), "--set",
            "realism=" + level, "--set", "goals=" + tour.goals, "--until", "900 s", "--record",
            file + "=localizer.RobotPosePush,truth.RobotPosePush"} +
          virtual_clock() + tour.floor,
      Seconds(300));
  INFO(run.err);
  REQUIRE(run.arrivals().size() == tour.count);
  CHECK(run.contacts().empty());
  return error_of(pairs_of(RecordTable(file)));
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

TEST_CASE("poses in a map that is made are within 5 cm of the truth", "[system][slam]") {
  const PoseError error = error_on(office(), "nominal", 1);
  CHECK(error.plain <= office().bar);
}

TEST_CASE("a map that is kept goes on another day, and a robot finds itself in the parts of both days",
          "[system][slam]") {
  const TempFolder folder;
  struct Day {
    std::string x, y;  // where the robot truly is switched on
    std::string goals;
    std::size_t count;
  };
  const std::string west = "kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8";
  const std::string to_hall = "hall: 3.6 7.6 > 3.6 6";
  const std::string east = "office_2: 9 6 > 9 4.4 > 9 2; meeting: 9 4.4 > 9 6 > 14.4 6 > 14.4 7.6 > 13 10.4";
  const std::string back = "hall: 9 4.4 > 9 6 > 3.6 6; " + west;
  for (const auto& [x, y, goals, count] :
       {Day{"1 m", "6 m", west + "; " + to_hall, 2}, {"3.6 m", "7 m", east, 2}, {"9 m", "2.6 m", back, 2}}) {
    const std::string file = folder.file("poses.csv");
    const bool is_first = x == "1 m";
    // A robot that is switched on does not know where it is.
    const Words lost =
        is_first ? Words{}
                 : Words{"--set", "dead_reckoning.start_x=0 m", "--set", "dead_reckoning.start_y=0 m"};
    const Run run = run_deployer(
        Words{source_file("tests/data/graphs/system/slam_drive.xml"), "--set", "realism=nominal", "--set",
              "world=" + source_file("sim/worlds/office.xml"), "--set", "x=" + x, "--set", "y=" + y, "--set",
              "goals=" + goals, "--set", "localizer.session=" + folder.file("office.session"), "--until",
              "300 s", "--log", "info", "--record", file + "=localizer.RobotPosePush,truth.RobotPosePush"} +
            lost + virtual_clock(),
        Seconds(120));
    INFO(x << '\n' << run.err);
    CHECK(run.arrivals().size() == count);
    CHECK(run.contacts().empty());
    CHECK(run.says("it has found where the robot is, and the map goes on") != is_first);
    const PoseError error = error_of(pairs_of(RecordTable(file)));
    std::cout << "day that begins at " << x << ": " << error.plain << " m\n";
    CHECK(error.plain <= office().bar);
  }
}

TEST_CASE("poses in maps of an office and of a hospital, at all levels, ten seeds", "[.][slow]") {
  std::vector<Tour> tours{office()};
  const std::string map = public_data("stage_maps/hospital.png");
  if (!map.empty()) tours.push_back(hospital(map));
  for (const Tour& tour : tours)
    for (const char* const level : {"nominal", "harsh", "recorded"})
      for (int seed = 1; seed <= 10; ++seed) {
        const PoseError error = error_on(tour, level, seed);
        std::cout << (tour.count == 7 ? "office " : "hospital ") << level << " seed " << seed << ": "
                  << error.plain << " m, laid " << error.laid << " m\n";
        CHECK(error.laid <= tour.bar);
      }
}

TEST_CASE("the real drivers of a Pioneer, too, give what its map is made of", "[system][slam]") {
  const Run run = run_deployer(Words{source_file("graphs/pioneer2dx_sick.xml"), "--profile", "emulate",
                                     "--profile", "slam", "--set", "realism=harsh", "--until", "200 s"} +
                                   virtual_clock(),
                               Seconds(120));
  INFO(run.err);
  CHECK(right_arrivals(run) == 3);
  CHECK(run.contacts().empty());
}

TEST_CASE(
    "in a given map a robot knows where it is at forty goals, through its drivers and with harsh wheels",
    "[.][slow]") {
  std::string goals;
  for (int round = 0; round < 10; ++round)
    goals += std::string(round == 0 ? "hall: 3.6 6; " : "; hall: 14.4 7.6 > 14.4 6 > 3.6 6; ") +
             "kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8; office_2: 3.6 7.6 > 3.6 6 > 9 6 > 9 4.4 > 9 2; meeting: 9 "
             "4.4 > 9 6 "
             "> 14.4 6 > 14.4 7.6 > 13 10.4";
  const TempFolder folder;
  const std::string file = folder.file("poses.csv");
  const Run run = run_deployer(
      Words{source_file("tests/data/graphs/system/known_day.xml"), "--set", "goals=" + goals, "--until",
            "3000 s", "--record", file + "=localizer.RobotPosePush,truth.RobotPosePush"} +
          virtual_clock(),
      Seconds(600));
  INFO(run.err);
  CHECK(run.contacts().empty());
  REQUIRE(run.arrivals().size() == 40);
  const std::vector<Pair> pairs = pairs_of(RecordTable(file));
  for (const Arrival& arrival : run.arrivals()) {
    const auto after = std::ranges::upper_bound(pairs, arrival.t, {}, &Pair::time);
    REQUIRE(after != pairs.begin());
    const double error = std::abs(std::prev(after)->by_map - std::prev(after)->truth);
    std::cout << arrival.name << " at " << arrival.t << " s: " << error << " m\n";
    CHECK(error < 0.1);
  }
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
