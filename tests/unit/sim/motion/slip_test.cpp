// SPDX-License-Identifier: GPL-3.0-or-later
// How a wheel slips on its way: the law of its growth, and that it does not jump.
#include "motion/slip_process.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "orca/sim/world.hpp"
#include "shipped.hpp"

using namespace orca::sim;
using orca::RandomStream;
using orca::sim::detail::SlipProcess;

namespace {

constexpr double kGrowth = 0.003;  // [m] per root of a metre
constexpr double kLength = 0.1;    // [m]

RandomStream stream(std::uint64_t seed = 1) { return {seed, "dewey", "wheels"}; }

// Returns the variance [m2] of the slip over `way`, from `ways` that follow one another.
double variance_over(double way, int ways, double step, double length = kLength) {
  SlipProcess slip(kGrowth, length);
  RandomStream random = stream();
  double squares = 0.0;
  for (int i = 0; i < ways; ++i) {
    double sum = 0.0;
    for (int k = 0; k < std::lround(way / step); ++k) sum += slip.over(step, random);
    squares += sum * sum / ways;
  }
  return squares;
}

// White noise through two first-order filters has the correlation (1 + s / l) exp(-s / l), with l half the length. Its double
// integral over a way, in closed form.
double expected_variance(double way) {
  const double l = 0.5 * kLength;
  const double tail = std::exp(-way / l);
  return kGrowth * kGrowth * (way - 1.5 * l + (1.5 * l + 0.5 * way) * tail);
}

// Returns the largest change of velocity [m/s2] and of turn rate [rad/s2] between two ticks of a Pioneer that is told to
// drive straight ahead, and the deviation of its turn rate [rad/s].
struct Roughness {
  double acceleration = 0.0, turn_acceleration = 0.0, turn_rate = 0.0;
};
Roughness roughness(Realism realism) {
  constexpr int kTicks = 6000;
  const double tick = orca::to_seconds(World::kTick);
  RobotModel pioneer = orca::sim::test::shipped("pioneer_2dx");
  pioneer.sonars.clear();
  Roughness found;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    World world({}, {.seed = seed, .realism = realism});
    const RobotId robot = world.add_robot("dewey", pioneer, {}).value();
    REQUIRE(world.set_velocity_command(robot, 0.5, 0.0));
    for (int i = 0; i < 300; ++i) world.step();
    double mean = 0.0, squares = 0.0;
    for (int i = 0; i < kTicks; ++i) {
      const orca::Twist2 before = world.velocity(robot);
      world.step();
      const orca::Twist2 now = world.velocity(robot);
      found.acceleration = std::max(found.acceleration, std::fabs(now.forward - before.forward) / tick);
      found.turn_acceleration =
          std::max(found.turn_acceleration, std::fabs(now.turn_rate - before.turn_rate) / tick);
      mean += now.turn_rate / kTicks;
      squares += now.turn_rate * now.turn_rate / kTicks;
    }
    found.turn_rate = std::max(found.turn_rate, std::sqrt(squares - mean * mean));
  }
  return found;
}

}  // namespace

TEST_CASE("on long ways slip grows with the root of the way, as white noise of the same strength does",
          "[sim][wheels]") {
  constexpr int kWays = 4000;
  // 0.999 of the variances of 4000 samples lie within 7.4 %.
  CHECK(variance_over(30.0, kWays, 0.01) == Approx(kGrowth * kGrowth * 30.0).epsilon(0.074 + 0.0025));
  CHECK(variance_over(5.0, kWays, 0.005) == Approx(expected_variance(5.0)).epsilon(0.074));
}

TEST_CASE("on ways as short as its length slip grows as its correlation says", "[sim][wheels]") {
  constexpr int kWays = 40000;  // 2.3 %; neighbouring ways are correlated, which widens it
  CHECK(variance_over(0.1, kWays, 0.001) == Approx(expected_variance(0.1)).epsilon(0.06));
  CHECK(variance_over(0.5, kWays, 0.002) == Approx(expected_variance(0.5)).epsilon(0.04));
}

TEST_CASE("slip grows alike in short steps and in long ones", "[sim][wheels]") {
  constexpr int kWays = 4000;
  for (const double step : {0.02, 0.1, 1.0}) {
    CAPTURE(step);
    CHECK(variance_over(30.0, kWays, step) == Approx(kGrowth * kGrowth * 30.0).epsilon(0.074 + 0.0025));
  }
  CHECK(variance_over(30.0, kWays, 0.1, 0.0) == Approx(kGrowth * kGrowth * 30.0).epsilon(0.074));
}

TEST_CASE("a wheel that stands slips no further, and rolls on with the slip that it had", "[sim][wheels]") {
  SlipProcess halting(kGrowth, kLength), going(kGrowth, kLength);
  RandomStream one = stream(), other = stream();
  for (int i = 0; i < 1000; ++i) {
    CHECK(halting.over(0.0, one) == 0.0);
    CHECK(halting.over(0.005, one) == going.over(0.005, other));
  }
}

TEST_CASE("a wheel's slip changes its sign with the direction in which it rolls, without a jump of its share",
          "[sim][wheels]") {
  SlipProcess slip(kGrowth, kLength);
  RandomStream random = stream();
  double share = slip.over(0.005, random) / 0.005;
  double widest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double way = (i / 100 % 2 == 0 ? 1.0 : -1.0) * 0.005;
    const double now = slip.over(way, random) / way;
    widest = std::max(widest, std::fabs(now - share));
    share = now;
  }
  // The share has the deviation growth / root(2 length), 0.7 %, and its slope that over l = 0.05 m.
  const double slope = kGrowth / std::sqrt(2.0 * kLength) / (0.5 * kLength);
  CHECK(widest < 6.0 * slope * 0.005);
  CHECK(widest > 1.0 * slope * 0.005);
}

TEST_CASE("from tick to tick slip changes a base's speed by less than its motors may", "[sim][wheels]") {
  const double limit = orca::sim::test::shipped("pioneer_2dx").drive.max_acceleration;
  for (const Realism realism : {Realism::nominal, Realism::harsh}) {
    const Roughness found = roughness(realism);
    constexpr double kDegree = std::numbers::pi / 180.0;
    INFO(to_string(realism) << ": " << found.acceleration << " m/s2, " << found.turn_acceleration / kDegree
                            << " deg/s2, turn rate " << found.turn_rate / kDegree << " deg/s");
    CHECK(found.acceleration < limit);
    CHECK(found.turn_rate < (realism == Realism::nominal ? 1.0 : 3.0) * kDegree);
  }
}
