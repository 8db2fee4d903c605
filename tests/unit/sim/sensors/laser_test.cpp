// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "laser.hpp"

using namespace orca::sim;
using orca::Pose2;
using namespace orca::sim::test;

namespace {

LaserScan first_scan(WorldModel model, const LaserScanner& laser, Realism realism = Realism::ideal) {
  World world(std::move(model), {.seed = 1, .realism = realism});
  const RobotId id = *world.add_robot("dewey", scout_with(laser), {});
  return next_scan(world, id);
}

}  // namespace

TEST_CASE("at ideal realism each beam of a laser reads the exact distance along it", "[sim][laser]") {
  const LaserScanner laser = lms200();
  const LaserScan scan = first_scan(wall_ahead(2.0), laser);
  REQUIRE(scan.ranges.size() == 181);
  for (std::size_t k = 0; k < scan.ranges.size(); ++k) {
    const double exact = 2.0 / std::cos(angle_of(laser, k));
    CHECK(scan.ranges[k] == Approx(exact < 8.0 && exact > 0.0 ? exact : 8.0).margin(1e-9));
  }
}

TEST_CASE("a scan is complete at the end of its period and carries the stamp of its first beam",
          "[sim][laser]") {
  World world(wall_ahead(2.0), {});
  const RobotId id = *world.add_robot("dewey", scout_with(lms200()), {});
  for (int tick = 1; tick <= 30; ++tick) {
    world.step();
    REQUIRE(world.laser(id).has_value() == (tick % 10 == 0));
    if (world.laser(id)) CHECK(world.laser(id)->stamp == world.time() - std::chrono::microseconds{6'660});
  }
}

TEST_CASE("a laser sees other robots and things as tall as itself, not its own robot", "[sim][laser]") {
  WorldModel model{
      "low and high", {{"low", Circle{{0, 1}, 0.2}, 0.25}, {"high", Circle{{0, -1}, 0.2}, 0.35}}, {}};
  World world(std::move(model), {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", scout_with(lms200()), {});
  REQUIRE(world.add_robot("other", scout(), {2, 0, 0}));
  const LaserScan scan = next_scan(world, id);
  CHECK(scan.ranges[90] == Approx(2.0 - 0.205).margin(1e-9));
  CHECK(scan.ranges[0] == Approx(0.8).margin(1e-9));
  CHECK(scan.ranges[180] == 8.0);
}

TEST_CASE("beyond eighty degrees of incidence a surface returns nothing", "[sim][laser]") {
  // Along a wall at 1 m to the left: the beam at angle a meets it at an incidence of 90 deg - a.
  const LaserScanner laser = lms200();
  const WorldModel model{"side", {{"side", Box{{0, 1.1, 0}, {40, 0.1}}, 2.5}}, {}};
  const LaserScan ideal = first_scan(model, laser);
  const LaserScan nominal = first_scan(model, laser, Realism::nominal);
  for (const std::size_t k : {98U, 99U}) {
    CHECK(ideal.ranges[k] < 8.0);
    CHECK(nominal.ranges[k] == 8.0);
  }
  for (std::size_t k = 101; k <= 180; ++k) CHECK(nominal.ranges[k] < 8.0);
}

TEST_CASE("each beam of a turning robot looks from where it was at that beam's instant", "[sim][laser]") {
  LaserScanner laser = lms200();
  laser.sweep = std::chrono::milliseconds{80};
  laser.center = {0.1, 0.05, 0.0};
  World world(wall_ahead(2.0), {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", scout_with(laser), {});
  constexpr double kTurn = 1.5;
  REQUIRE(world.set_velocity_command(id, 0.0, kTurn));
  for (int i = 0; i < 100; ++i) world.step();  // It has come up to speed.
  REQUIRE(world.velocity(id).turn_rate == Approx(kTurn));
  const LaserScan scan = next_scan(world, id);
  double skew = 0.0;
  int seen = 0;
  for (std::size_t k = 0; k < laser.count; ++k) {
    const auto seconds_before_end = 0.08 * (1.0 - static_cast<double>(k) / 180.0);
    const Pose2 at{0, 0, world.pose(id).yaw - kTurn * seconds_before_end};
    const auto range_from = [&](const Pose2& X_WB) {
      const Pose2 X_WL = X_WB * laser.center;
      return (2.0 - X_WL.x) / std::cos(X_WL.yaw + angle_of(laser, k));
    };
    const double exact = range_from(at);
    if (exact < 0.0 || exact > 7.9) continue;
    CHECK(scan.ranges[k] == Approx(exact).margin(1e-6));
    const double still = range_from(world.pose(id));
    if (still > 0.0) skew = std::fmax(skew, std::fabs(still - exact));
    ++seen;
  }
  CHECK(seen > 30);
  CHECK(skew > 0.1);  // The error of a scan that was taken at one instant.
}

TEST_CASE("a scan among a few things is the same when many others stand out of sight", "[sim][laser]") {
  LaserScanner laser = lms200();
  laser.sweep = std::chrono::milliseconds{GENERATE(0, 7, 80)};
  laser.center = {0.1, 0.05, 0.0};
  const auto scans = [&](int out_of_sight) {
    World world({}, {.seed = 1, .realism = Realism::nominal});
    const RobotId id = *world.add_robot("dewey", scout_with(laser), {});
    for (int i = 0; i < 4; ++i) {
      const double angle = 1.5 * i;
      REQUIRE(world.add_obstacle("near" + std::to_string(i), Box{{}, {0.2, 0.1}}, 1.0,
                                 {2.0 * std::cos(angle), 2.0 * std::sin(angle), angle + 0.4}));
    }
    for (int i = 0; i < out_of_sight; ++i)
      REQUIRE(world.add_obstacle("far" + std::to_string(i), Circle{{}, 0.3}, 1.0, {40.0 + i, 0, 0}));
    REQUIRE(world.set_velocity_command(id, 0.3, 1.5));
    std::vector<double> ranges;
    for (int round = 0; round < 30; ++round) {
      const LaserScan scan = next_scan(world, id);
      ranges.insert(ranges.end(), scan.ranges.begin(), scan.ranges.end());
    }
    return ranges;
  };
  const std::vector<double> few = scans(0);
  CHECK(std::ranges::count_if(few, [](double range) { return range < 4.0; }) > 300);
  CHECK(scans(20) == few);
}

TEST_CASE("the same seed gives the same scans, another seed others", "[sim][laser]") {
  const auto ranges = [](std::uint64_t seed) {
    World world(wall_ahead(2.0), {.seed = seed, .realism = Realism::nominal});
    const RobotId id = *world.add_robot("dewey", scout_with(lms200()), {});
    next_scan(world, id);
    return next_scan(world, id).ranges;
  };
  CHECK(ranges(1) == ranges(1));
  CHECK(ranges(1) != ranges(2));
}
