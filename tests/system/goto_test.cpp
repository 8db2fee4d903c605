// SPDX-License-Identifier: GPL-3.0-or-later
// Goto takes its pose from any source that it is connected to, and its goals may lie above the floor.
#include <catch2/catch.hpp>
#include <cmath>
#include <regex>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

Run by_odometry(const std::string& goals, const Words& more = {}) {
  return run_deployer(Words{system_graph("goto_odometry.xml"), "--set", "goals=" + goals} + virtual_clock() +
                      more);
}

}  // namespace

TEST_CASE("without a localizer Goto drives by odometry, in the frame in which the robot began",
          "[system][goto]") {
  const Run run = by_odometry("ahead: 1 0; aside: 1 1");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const auto arrivals = run.arrivals();
  REQUIRE(arrivals.size() == 2);
  CHECK(std::hypot(arrivals[0].x - 1.0, arrivals[0].y) < 0.2);
  CHECK(std::hypot(arrivals[1].x - 1.0, arrivals[1].y - 1.0) < 0.2);
}

TEST_CASE(
    "a goal a little above the floor is reached nearer to it, one out of reach is refused with a reason",
    "[system][goto]") {
  const Run low = by_odometry("low: 1 0 0.15");
  INFO(low.err);
  REQUIRE(low.arrivals().size() == 1);
  CHECK(std::hypot(low.arrivals()[0].x - 1.0, low.arrivals()[0].y) < std::sqrt(0.2 * 0.2 - 0.15 * 0.15));
  const Run high = by_odometry("high: 1 0 1.5", {"--until", "5 s"});
  CHECK(high.arrivals().empty());
  CHECK(high.says("the goal \"high\" lies so far above or below the robot"));
}

TEST_CASE("Goto turns to the direction asked for before it says that it has arrived", "[system][goto]") {
  const Run there = by_odometry("there: 1 0");
  const Run facing = by_odometry("facing: 1 0 @ 180");
  REQUIRE(there.arrivals().size() == 1);
  REQUIRE(facing.arrivals().size() == 1);
  CHECK(facing.arrivals()[0].t > there.arrivals()[0].t + 1.0);
}

TEST_CASE(
    "the shipped Scout that drives by odometry alone does not say that it has arrived where its position is "
    "less sure "
    "than the reach",
    "[system][goto]") {
  const Words graph = Words{source_file("graphs/scout_odometry.xml")} + virtual_clock();
  const Run knows = run_deployer(graph);
  INFO(knows.err << knows.out);
  CHECK(knows.arrivals().size() == 1);
  CHECK(knows.exit_code() == 1);
  CHECK(knows.contacts().empty());
  CHECK(knows.says("its position is known only to"));
  // A file that guesses nothing does not make it exact: it counts as wrong as the shipped ones.
  const TempFolder folder;
  const std::string without = std::regex_replace(read_text(ORCA_SOURCE_DIR "/sim/robots/nomad_scout.urdf"),
                                                 std::regex("<(wheel|range)_errors[^>]*/>"), "");
  const Run guesses = run_deployer(graph + Words{"--set", "robot=" + folder.write("scout.urdf", without)});
  INFO(guesses.err);
  CHECK(guesses.arrivals().size() == 1);
  CHECK(guesses.exit_code() == 1);
  CHECK(guesses.says("its position is known only to"));
}
