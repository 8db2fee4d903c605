// SPDX-License-Identifier: GPL-3.0-or-later
// Transducers that are silent all through a run.
#include <catch2/catch.hpp>

#include <set>

#include "laser.hpp"

using namespace orca::sim;
using namespace orca::sim::test;

namespace {

// A room of 4 x 4 m in which every transducer of a Scout hears something at ideal.
WorldModel small_room() {
  WorldModel model{"room", {}, {}};
  for (int side = 0; side < 4; ++side) {
    const double yaw = 0.5 * std::numbers::pi * side;
    model.obstacles.push_back(
        {"wall", Box{{2.0 * std::cos(yaw), 2.0 * std::sin(yaw), yaw}, {0.05, 2.0}}, 2.5});
  }
  return model;
}

// The transducers of a robot that heard nothing in any of its first five rounds.
std::set<std::size_t> silent(double share, std::uint64_t seed, const std::string& name = "dewey") {
  ErrorLevels errors;
  errors.sonar_dead = share;
  World world(small_room(), {.seed = seed, .errors = errors});
  const RobotId id = *world.add_robot(name, scout(), {});
  std::set<std::size_t> never;
  for (std::size_t k = 0; k < 16; ++k) never.insert(k);
  for (int round = 0; round < 5; ++round) {
    do world.step();
    while (!world.sonar(id));
    for (const SonarReading& reading : world.sonar(id)->readings) {
      if (reading.echo) never.erase(reading.transducer);
      if (!reading.echo) CHECK(reading.range == 6.5);
    }
  }
  return never;
}

}  // namespace

TEST_CASE("a share of the transducers is silent all through a run, each robot's own",
          "[sim][sonar][silent]") {
  constexpr int kRobots = 100;
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= kRobots; ++seed) sum += static_cast<double>(silent(0.25, seed).size());
  // 1,600 transducers: 3.29 deviations of the share.
  CHECK(sum / (16.0 * kRobots) == Approx(0.25).margin(3.29 * std::sqrt(0.25 * 0.75 / 1600.0)));
  CHECK(silent(0.25, 1) == silent(0.25, 1));
  CHECK(silent(0.25, 1) != silent(0.25, 2));
  CHECK(silent(0.25, 1) != silent(0.25, 1, "huey"));
}

TEST_CASE("without a share every transducer hears, with a share of 1 none does", "[sim][sonar][silent]") {
  CHECK(silent(0.0, 1).empty());
  CHECK(silent(1.0, 1).size() == 16);
}

TEST_CASE("a silent transducer neither reads outliers nor disturbs others", "[sim][sonar][silent]") {
  ErrorLevels errors = error_levels(Realism::harsh);
  errors.sonar_dead = 1.0;
  World world(small_room(), {.seed = 1, .errors = errors});
  const RobotId id = *world.add_robot("dewey", scout(), {});
  int readings = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    world.step();
    if (!world.sonar(id)) continue;
    for (const SonarReading& reading : world.sonar(id)->readings) {
      CHECK_FALSE(reading.echo);
      ++readings;
    }
  }
  CHECK(readings == 1600);
}
