// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>

#include "bases.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using Catch::Contains;

namespace {

constexpr double kSpeed = 1.0;         // [rad/s]
constexpr double kAcceleration = 4.0;  // [rad/s2]

// A synchro base whose sonars are on a turret.
RobotModel turreted(DriveKind kind = DriveKind::synchro) {
  RobotModel model = base_of(kind);
  model.turret = Turret{"turret_joint", kSpeed, kAcceleration, std::chrono::milliseconds{50}, {}};
  model.sonars[0].on_turret = true;
  return model;
}

double angle_of(const Bench& bench) { return bench.world.turret(bench.id).value().angle; }

// Returns the next round of the sonars, which begins after now.
SonarScan next_round(Bench& bench) {
  for (int rounds = 0; rounds < 2;) {
    bench.run(0.01);
    if (bench.world.sonar(bench.id)) ++rounds;
  }
  return *bench.world.sonar(bench.id);
}

}  // namespace

TEST_CASE(
    "a turret goes to its angle with full acceleration, at full speed, and stops there without swinging",
    "[sim][turret]") {
  const double angle = GENERATE(2.0, -2.0);
  Bench bench(turreted(), Realism::ideal);
  REQUIRE(bench.world.set_turret_command(bench.id, angle));
  // A trapezoid of speed: the way at full speed, and one ramp more.
  const double time = std::fabs(angle) / kSpeed + kSpeed / kAcceleration;
  double fastest = 0.0;
  double farthest = 0.0;
  for (int tick = 0; tick < static_cast<int>(time * 100.0) - 8; ++tick) {
    bench.run(0.01);
    fastest = std::max(fastest, std::fabs(bench.world.turret(bench.id)->turn_rate));
  }
  CHECK(fastest == Approx(kSpeed));
  CHECK(std::fabs(angle_of(bench) - angle) > 1e-3);
  for (int tick = 0; tick < 30; ++tick) {
    bench.run(0.01);
    farthest = std::max(farthest, std::fabs(angle_of(bench)));
  }
  CHECK(angle_of(bench) == Approx(angle).margin(1e-6));
  CHECK(bench.world.turret(bench.id)->turn_rate == Approx(0.0).margin(1e-6));
  CHECK(farthest < std::fabs(angle) + 1e-6);
}

TEST_CASE("a turret turns the shorter way", "[sim][turret]") {
  Bench bench(turreted(), Realism::ideal);
  REQUIRE(bench.world.set_turret_command(bench.id, 3.0));
  bench.run(5.0);
  REQUIRE(bench.world.set_turret_command(bench.id, -3.0));
  bench.run(0.7);  // By the longer way it would take six seconds.
  CHECK(angle_of(bench) == Approx(-3.0).margin(1e-3));
}

TEST_CASE("a turret keeps its angle to the way the wheels point while they steer", "[sim][turret]") {
  const double angle = GENERATE(0.0, 1.0);
  Bench bench(turreted(), Realism::ideal);
  REQUIRE(bench.world.set_turret_command(bench.id, angle));
  bench.run(3.0);
  bench.drive({.turn_rate = 0.8});
  for (int tick = 0; tick < 300; ++tick) {
    bench.run(0.01);
    REQUIRE(angle_of(bench) == Approx(angle).margin(1e-6));
  }
  CHECK(bench.pose().yaw > 2.0);
}

TEST_CASE("a turret lags for a while behind wheels that steer faster than it can turn", "[sim][turret]") {
  Bench bench(turreted(), Realism::ideal);
  bench.drive({.turn_rate = 2.0});
  bench.run(1.0);
  CHECK(angle_of(bench) < -0.5);
  bench.drive({});
  bench.run(4.0);
  CHECK(angle_of(bench) == Approx(0.0).margin(1e-6));
}

TEST_CASE("a turret obeys after the base's dead time", "[sim][turret]") {
  Bench bench(turreted(), Realism::nominal);
  REQUIRE(bench.world.set_turret_command(bench.id, 1.0));
  bench.run(0.05);
  CHECK(angle_of(bench) == 0.0);
  bench.run(0.01);
  CHECK(angle_of(bench) > 0.0);
}

TEST_CASE("sensors on a turret look where it points, and say so in the robot's frame", "[sim][turret]") {
  // The test room's north wall is 2 m to the left of the robot, the others are farther.
  Bench bench(turreted(), Realism::ideal, {-2.0, 3.0, 0.0});
  REQUIRE(bench.world.set_turret_command(bench.id, 0.5 * std::numbers::pi));
  bench.run(3.0);
  const SonarScan round = next_round(bench);
  const SonarReading first = round.readings[0];
  CHECK(first.sensor.yaw == Approx(0.5 * std::numbers::pi).margin(1e-6));
  CHECK(first.sensor.y == Approx(0.19).margin(1e-6));
  CHECK(first.range == Approx(2.0 - 0.19).margin(1e-3));
  CHECK(round.X_RB.yaw == Approx(0.5 * std::numbers::pi).margin(1e-6));
  CHECK(std::ranges::min(round.readings, {}, &SonarReading::stamp).stamp == round.stamp);
}

TEST_CASE(
    "what sensors on a turret that goes round measure lies where it stands, while the robot drives and "
    "steers",
    "[sim][turret]") {
  constexpr Vec2 kPost{1.2, 0.4};
  constexpr double kRadius = 0.02;
  constexpr double kHalfBeam = 4.0 * std::numbers::pi / 180.0;
  RobotModel model = turreted();
  InfraredRing ring;
  ring.name = "infrared";
  ring.count = 16;
  ring.pitch = std::numbers::pi / 8.0;
  ring.half_beam = kHalfBeam;
  ring.max_range = 0.76;
  ring.radius = 0.19;
  ring.height = 0.3;
  ring.period = std::chrono::milliseconds{50};
  ring.on_turret = true;
  model.infrareds = {ring};
  World world({"post", {{"post", Circle{kPost, kRadius}, 2.5}}, {}}, {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", model, {});
  REQUIRE(world.set_velocity_command(id, {.forward = 0.3, .turn_rate = 0.2}));
  int seen = 0;
  for (int tick = 0; tick < 400; ++tick) {
    REQUIRE(world.set_turret_command(id, orca::wrapped(world.turret(id)->angle + 1.5)));
    world.step();
    const auto& scan = world.infrared(id);
    if (!scan) continue;
    for (std::size_t k = 0; k < ring.count; ++k) {
      if (scan->ranges[k] >= ring.max_range) continue;
      ++seen;
      const Vec2 echo = world.pose(id) * scan->X_RB * ring.sensor(k) * Vec2{scan->ranges[k], 0.0};
      REQUIRE(norm(echo - kPost) < kRadius + scan->ranges[k] * kHalfBeam);
    }
  }
  CHECK(seen > 20);
  CHECK(std::fabs(world.turret(id)->turn_rate) > 0.5);
}

TEST_CASE("sensors on the body of a synchro base stay behind when the wheels steer, and say so",
          "[sim][turret]") {
  Bench bench(base_of(DriveKind::synchro), Realism::ideal, {-2.0, 3.0, 0.0});
  bench.drive({.turn_rate = 1.0});
  bench.run(0.5 * std::numbers::pi);
  bench.drive({});
  bench.run(1.0);
  const double steered = bench.pose().yaw;
  REQUIRE(steered > 1.5);
  const SonarReading left = next_round(bench).readings[4];  // It looks to the left of the body.
  CHECK(left.sensor.yaw == Approx(0.5 * std::numbers::pi - steered).margin(1e-9));
  CHECK(left.range == Approx(2.0 - 0.19).margin(1e-3));
}

TEST_CASE("a turret on a base that turns keeps the commanded angle in the robot's frame", "[sim][turret]") {
  Bench bench(turreted(DriveKind::differential), Realism::ideal);
  REQUIRE(bench.world.set_turret_command(bench.id, -1.0));
  bench.drive({.turn_rate = 0.5});
  bench.run(3.0);
  CHECK(angle_of(bench) == Approx(-1.0).margin(1e-6));
  CHECK(bench.body() == bench.pose());
}

TEST_CASE("a turret command to a robot without one, or to nowhere, is refused", "[sim][turret]") {
  Bench with(turreted(), Realism::ideal);
  const orca::Status nowhere = with.world.set_turret_command(with.id, std::nan(""));
  REQUIRE_FALSE(nowhere);
  CHECK(nowhere.error().code == orca::Code::invalid_argument);
  Bench without(scout(), Realism::ideal);
  const orca::Status nothing = without.world.set_turret_command(without.id, 1.0);
  REQUIRE_FALSE(nothing);
  CHECK_THAT(nothing.error().text(), Contains("this robot has no turret"));
  CHECK_FALSE(without.world.turret(without.id));
}
