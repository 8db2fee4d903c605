// SPDX-License-Identifier: GPL-3.0-or-later
// A Scout that follows walls by its sonars.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <optional>
#include <vector>

#include "deployer.hpp"
#include "record_table.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr double kRadius = 0.205;  // [m] of a Scout with its bumpers
constexpr double kDistance = 0.4;  // [m] that the graph keeps

// A hall of 14 x 6.95 m with two doors in its north wall, and a block of 2 m at its south wall: four inner corners, two more beside the
// block, and its two outer ones.
const char* const kHall = R"(<world name="hall" version="1">
  <room name="building" from="0 0" to="14 9" thickness="0.2 m"/>
  <wall name="north" from="0 7" to="14 7"><door at="3.0 m" width="0.9 m"/><door at="10.0 m" width="0.95 m"/></wall>
  <box name="block" x="7 m" y="1.1 m" length="2 m" width="2 m"/>
  <place name="start" x="2" y="4"/>
</world>)";

// Returns how far off [m] a robot beside a straight wall of the hall is; positive: too far. Nothing elsewhere, and within 1.5 m of a corner.
std::optional<double> off_wall(double x, double y) {
  const double wanted = kRadius + kDistance;
  const bool is_along = x > 1.5 && x < 12.5;
  if (is_along && y > 5.0) return 6.95 - y - wanted;
  if (y > 1.5 && y < 5.5 && x < 2.5) return x - 0.1 - wanted;
  if (y > 1.5 && y < 5.5 && x > 11.5) return 13.9 - x - wanted;
  if (is_along && (x < 4.6 || x > 9.4) && y < 2.0) return y - 0.1 - wanted;
  return std::nullopt;
}

Run follow(const std::string& graph, const Words& more) {
  const TempFolder folder;
  return run_deployer(Words{folder.write("scout_wall.xml", graph)} + virtual_clock() + more, Seconds(60));
}

// Adds how far off the robot is along straight walls, and past doors, from when it is at one for the first time.
void add_errors(const RecordTable& poses, std::vector<double>& errors) {
  bool is_there = false;
  for (const auto& row : poses.rows("truth.RobotPosePush")) {
    const auto off = off_wall(number(row, "x"), number(row, "y"));
    is_there = is_there || (off && std::abs(*off) < 0.05);
    if (off && is_there) errors.push_back(std::abs(*off));
  }
}

}  // namespace

TEST_CASE(
    "a Scout keeps its distance along straight walls, past doors and round corners, and touches nothing",
    "[system][wall]") {
  const TempFolder folder;
  ShippedGraph graph("scout_wall");
  graph.add(R"(<component name="truth" type="orca.TruthLocalizer" hardware="scout" autonomous="true"/>)");
  const std::string world = "world=" + folder.write("hall.xml", kHall);
  const std::string file = folder.file("poses.csv");
  for (const std::string realism : {"nominal", "harsh"}) {
    std::vector<double> errors;
    for (int seed = 1; seed <= 5; ++seed) {
      for (const std::string side : {"left", "right"}) {
        const Run run =
            follow(graph.text(), {"--until", "300 s", "--seed", std::to_string(seed), "--set", world, "--set",
                                  "realism=" + realism, "--set", "side=" + side, "--set", "distance=0.4 m",
                                  "--record", file + "=truth.RobotPosePush"});
        CAPTURE(realism, seed, side, run.err);
        CHECK(run.exit_code() == 0);
        CHECK(run.contacts().empty());
        const std::size_t before = errors.size();
        add_errors(RecordTable(file), errors);
        CHECK(errors.size() > before + 1000);  // of 3000: it goes round
      }
    }
    std::ranges::sort(errors);
    const double median = errors[errors.size() / 2];
    const double most = errors[errors.size() * 95 / 100];
    std::cout << realism << ": median " << median << " m, 95 % " << most << " m off a wall\n";
    CHECK(median < 0.05);
    CHECK(most < 0.15);
  }
}

TEST_CASE("a Scout that keeps 10 cm from walls needs SonarAvoid to touch nothing", "[system][wall]") {
  ShippedGraph alone("scout_wall");
  alone.remove("avoid");
  const Words close{"--until", "300 s", "--set", "distance=0.1 m", "--set", "realism=harsh"};
  const Run with = follow(ShippedGraph("scout_wall").text(), close);
  INFO(with.err);
  CHECK(with.contacts().empty());
  const Run without = follow(alone.text(), close);
  INFO(without.err);
  CHECK(without.ended);
  CHECK_FALSE(without.contacts().empty());
}

TEST_CASE("a Scout whose FollowWall, fuser or base is silent does not move", "[system][wall]") {
  ShippedGraph graph("scout_wall");
  graph.watch_motion("base");
  for (const char* const fault : {"follow=silent@0s", "fuser=silent@0s", "base=silent@0s"}) {
    const Run run = follow(graph.text(), {"--until", "20 s", "--fail", fault});
    CAPTURE(fault, run.err);
    CHECK_FALSE(run.says("watch: moves after"));
  }
}
