// SPDX-License-Identifier: GPL-3.0-or-later
// The errors of ranges are distributed as docs/simulated-devices.md says. Each bound is passed by chance alone in
// one run of a thousand; the seeds are fixed, so a run is either always fine or never.
#include <catch2/catch.hpp>

#include "laser.hpp"
#include "statistics.hpp"

using namespace orca::sim;
using namespace orca::sim::test;

namespace {

constexpr double kBias = 0.01;
constexpr double kSigma = 0.005;

constexpr double kWall = 2.0;  // [m] Distance of the wall.

// Returns the deviation of a beam that meets the wall at an angle [rad], relative to that of a strong echo: the wall scatters five
// times as much light as the reference of 10 %, and the weakest echo is 0.64 of that at 8 m.
double relative_deviation(double angle) {
  const double range = kWall / std::cos(angle);
  const double strength = 5.0 * std::cos(angle) * std::pow(8.0 / range, 2) / 0.64;
  return std::sqrt(1.0 + 10.0 / strength);
}

// Errors of all beams of `scans` scans of a wall, each relative to its deviation; the beams meet it at distances that differ by no
// whole steps.
std::vector<double> laser_errors(std::uint64_t seed, double quantum, int scans) {
  LaserScanner laser = lms200();
  laser.quantum = quantum;
  World world(wall_ahead(kWall), {.seed = seed, .realism = Realism::nominal});
  const RobotId id = *world.add_robot("dewey", scout_with(laser), {});
  std::vector<double> errors;
  for (int i = 0; i < scans; ++i) {
    const LaserScan scan = next_scan(world, id);
    for (std::size_t k = 30; k <= 150; ++k)
      errors.push_back((scan.ranges[k] - kWall / std::cos(angle_of(laser, k))) /
                       relative_deviation(angle_of(laser, k)));
  }
  return errors;
}

// Readings of the transducer ahead, at a wall 3 m from it. It fires so rarely that it does not hear itself.
std::vector<double> sonar_ranges(double quantum, std::size_t n) {
  RobotModel model = scout();
  SonarRing& ring = model.sonars[0];
  ring.count = 1;
  ring.order = {0};
  ring.quantum = quantum;
  ring.period = std::chrono::milliseconds{50};
  World world(wall_ahead(3.19), {.seed = 6, .realism = Realism::nominal});
  const RobotId id = *world.add_robot("dewey", model, {});
  std::vector<double> ranges;
  while (ranges.size() < n) {
    world.step();
    if (world.sonar(id)) ranges.push_back(world.sonar(id)->readings[0].range);
  }
  return ranges;
}

}  // namespace

TEST_CASE("a laser's bias is the same all through a run and uniform over runs",
          "[sim][laser][validation][statistics]") {
  std::vector<double> biases;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const std::vector<double> errors = laser_errors(seed, 0.0, 4);
    biases.push_back(mean(errors));
    const std::vector<double> early(errors.begin(), errors.begin() + 242);
    const std::vector<double> late(errors.begin() + 242, errors.end());
    // 4.7 standard errors: among 300 comparisons one in a thousand.
    CHECK(std::fabs(mean(early) - mean(late)) < 4.7 * kSigma * std::sqrt(2.0 / 242.0));
  }
  // The mean of 484 beams blurs each bias by 0.2 mm, a hundredth of the range: well below the bound's 11 %.
  CHECK(distance_from(biases, [](double b) { return std::clamp((b + kBias) / (2 * kBias), 0.0, 1.0); }) <
        critical_distance(biases.size()));
}

TEST_CASE("a laser's ranges are normal about the bias, with the given deviation",
          "[sim][laser][validation][statistics]") {
  const std::vector<double> errors = laser_errors(3, 0.0, 40);
  const double bias = mean(errors);
  CHECK(std::fabs(bias) < kBias + 3.29 * kSigma / std::sqrt(static_cast<double>(errors.size())));
  CHECK(variance(errors) == Approx(kSigma * kSigma).epsilon(critical_variance(errors.size())));
  CHECK(distance_from(errors, [&](double e) { return normal_cdf((e - bias) / kSigma); }) <
        critical_distance(errors.size()));
}

TEST_CASE("a laser's ranges come in whole steps, which add a twelfth of a step's square to the variance",
          "[sim][laser][validation][statistics]") {
  constexpr double kStep = 0.01;
  LaserScanner laser = lms200();
  World world(wall_ahead(2.0), {.seed = 3, .realism = Realism::nominal});
  const RobotId id = *world.add_robot("dewey", scout_with(laser), {});
  for (const double range : next_scan(world, id).ranges)
    CHECK(range / kStep == Approx(std::round(range / kStep)).margin(1e-6));
  const std::vector<double> errors = laser_errors(3, kStep, 40);
  // Beams that look to both sides share their true range, so half the readings count.
  CHECK(variance(errors) ==
        Approx(kSigma * kSigma + kStep * kStep / 12.0).epsilon(critical_variance(errors.size() / 2)));
}

TEST_CASE("a sonar's ranges are normal with one percent deviation, except for one percent of outliers",
          "[sim][sonar][validation][statistics]") {
  constexpr std::size_t kReadings = 5000;
  const std::vector<double> ranges = sonar_ranges(0.0, kReadings);
  const auto expected = [](double r) {
    return 0.99 * normal_cdf((r - 3.0) / 0.03) + 0.01 * (r - 0.15) / (6.5 - 0.15);
  };
  CHECK(distance_from(ranges, expected) < critical_distance(kReadings));
  const auto wild = std::ranges::count_if(ranges, [](double r) { return std::fabs(r - 3.0) > 0.15; });
  // Binomial with n = 5000 and p = 0.01 * (1 - 0.3 / 6.35): 47.6 expected, deviation 6.9.
  CHECK(std::fabs(static_cast<double>(wild) - 47.6) < 3.29 * 6.9);
}

TEST_CASE("a sonar's ranges come in the ring's steps", "[sim][sonar][validation][statistics]") {
  for (const double range : sonar_ranges(0.0254, 500)) {
    const double steps = range / 0.0254;
    CHECK((range == 6.5 || range == 0.15 || std::fabs(steps - std::round(steps)) < 1e-6));
  }
}
