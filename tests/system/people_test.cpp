// SPDX-License-Identifier: GPL-3.0-or-later
// A robot among people who walk about: graphs/pioneer_people.xml, with its PersonTracker and without.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "deployer.hpp"
#include "slow_run.hpp"

using namespace orca::test;

namespace {

constexpr double kHarmless = 0.1;  // [m/s]

Run drive(int seed, const Words& arguments = {}) {
  return run_deployer(
      Words{source_file("graphs/pioneer_people.xml"), "--until", "120 s", "--seed", std::to_string(seed)} +
      arguments + virtual_clock());
}

// Returns the speed of the robot at the fastest touch of somebody [m/s]; 0: it touches nobody, or stands.
double fastest_touch(const Run& run) {
  const std::string before = "the robot moves at ";
  double fastest = 0.0;
  for (const std::string& line : run.said(" touches "))
    if (const std::size_t at = line.find(before); at != std::string::npos)
      fastest = std::max(fastest, std::strtod(line.c_str() + at + before.size(), nullptr));
  return fastest;
}

}  // namespace

TEST_CASE("among six people a robot that knows who walks where runs into fewer of them, and arrives",
          "[system][people]") {
  const int seeds = part_of(40);
  int run_into = 0, without = 0, arrived = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Run run = drive(seed);
    CAPTURE(seed, run.err);
    run_into += fastest_touch(run) > kHarmless ? 1 : 0;
    arrived += run.arrivals().size() == 1 ? 1 : 0;
    without += fastest_touch(drive(seed, {"--profile", "gate"})) > kHarmless ? 1 : 0;
  }
  CAPTURE(seeds, run_into, without, arrived);
  CHECK(arrived >= 0.95 * seeds);
  CHECK(run_into <= 0.1 * seeds);
  CHECK(without > run_into);
}

TEST_CASE("a gate whose tracker falls silent lets nothing pass, and says so", "[system][people]") {
  const std::string hall = "world=" + source_file("sim/experiments/to_goal/empty_hall.xml");
  CHECK(drive(1, {"--set", hall}).arrivals().size() == 1);
  const Run run = drive(1, {"--set", hall, "--fail", "people=silent@5s"});
  INFO(run.err);
  CHECK(run.arrivals().empty());
  CHECK(run.says("alarm SENSOR_SILENT: the robot stands: nothing valid comes at its port \"moving\""));
}
