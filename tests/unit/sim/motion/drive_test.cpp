// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of drive against closed forms.
#include <catch2/catch.hpp>

#include <complex>

#include "bases.hpp"

using namespace orca::sim;
using orca::Pose2;
using orca::Twist2;
using orca::wrapped;
using namespace orca::sim::test;
using Catch::Contains;

namespace {

constexpr DriveKind kAll[] = {DriveKind::differential, DriveKind::synchro, DriveKind::holonomic};
using Complex = std::complex<double>;

// Returns the final pose of a base with constant velocity in its own frame: the integral of its turning
// velocity.
Complex integrated(const Twist2& velocity, double seconds) {
  const Complex turn(0.0, velocity.turn_rate * seconds);
  const Complex moved = Complex(velocity.forward, velocity.left) * seconds;
  return moved * (std::exp(turn) - 1.0) / turn;
}

}  // namespace

TEST_CASE("each kind of base answers a small command after the dead time with its first-order lag",
          "[sim][drive]") {
  const DriveKind kind = GENERATE(from_range(std::begin(kAll), std::end(kAll)));
  Bench bench(base_of(kind), Realism::nominal);
  const double left = kind == DriveKind::holonomic ? 0.01 : 0.0;
  bench.drive({.forward = 0.02, .left = left, .turn_rate = 0.1});
  bench.run(0.05);
  CHECK(bench.rolled() == Twist2{});
  for (int n = 1; n <= 30; ++n) {
    bench.run(0.01);
    const double share = 1.0 - std::exp(-n * 0.01 / 0.1);
    CHECK(bench.rolled().forward == Approx(0.02 * share).margin(1e-12));
    CHECK(bench.rolled().turn_rate == Approx(0.1 * share).margin(1e-12));
    CHECK(bench.rolled().left == Approx(left * share).margin(1e-12));
  }
}

TEST_CASE("harsh realism makes lag and dead time half as long again", "[sim][drive]") {
  Bench bench(base_of(DriveKind::holonomic), Realism::harsh);
  bench.drive({.left = 0.02});
  bench.run(0.08);  // 75 ms, in whole ticks.
  CHECK(bench.rolled().left == 0.0);
  bench.run(0.3);
  CHECK(bench.rolled().left == Approx(0.02 * (1.0 - std::exp(-0.3 / 0.15))).margin(1e-12));
}

TEST_CASE("each kind of base keeps to its acceleration and speed limits", "[sim][drive]") {
  const DriveKind kind = GENERATE(from_range(std::begin(kAll), std::end(kAll)));
  Bench bench(base_of(kind), Realism::ideal);
  bench.drive({.forward = 5.0, .turn_rate = 9.0});
  bench.run(0.2);
  CHECK(bench.velocity().forward == Approx(0.2 * 0.76));
  CHECK(bench.velocity().turn_rate == Approx(0.2 * 4.0));
  bench.run(1.8);
  CHECK(bench.velocity().forward == Approx(1.0));
  CHECK(bench.velocity().turn_rate == Approx(2.0));
}

TEST_CASE(
    "an emergency stop brakes each kind of base evenly, without lag, harder than its acceleration limit",
    "[sim][drive]") {
  const DriveKind kind = GENERATE(from_range(std::begin(kAll), std::end(kAll)));
  RobotModel model = base_of(kind);
  model.drive.stop_deceleration = 3.0;
  Bench bench(model, Realism::nominal);
  bench.drive({.forward = 0.6, .turn_rate = 0.3});
  bench.run(3.0);
  bench.stop();
  bench.run(0.05);  // dead time
  CHECK(bench.rolled().forward == Approx(0.6));
  bench.run(0.1);
  CHECK(bench.rolled().forward == Approx(0.3));
  CHECK(bench.rolled().turn_rate == 0.0);  // 4 rad/s2, in the same proportion
  bench.run(0.11);
  CHECK(bench.rolled() == Twist2{});
  bench.drive({.forward = 0.02});
  bench.run(0.05 + 0.1);
  CHECK(bench.rolled().forward == Approx(0.02 * (1.0 - std::exp(-1.0))));
}

TEST_CASE("an emergency stop of a base that has none is a velocity of 0", "[sim][drive]") {
  const DriveKind kind = GENERATE(from_range(std::begin(kAll), std::end(kAll)));
  Bench one(base_of(kind), Realism::nominal);
  Bench other(base_of(kind), Realism::nominal);
  for (Bench* bench : {&one, &other}) {
    bench->drive({.forward = 0.6, .turn_rate = 0.3});
    bench->run(3.0);
  }
  one.stop();
  other.drive({});
  for (int n = 0; n < 100; ++n) {
    one.run(0.01);
    other.run(0.01);
    CHECK(one.rolled() == other.rolled());
  }
}

TEST_CASE("a holonomic base's limits hold for its speed in whatever direction", "[sim][drive]") {
  Bench bench(base_of(DriveKind::holonomic), Realism::ideal);
  bench.drive({.forward = 3.0, .left = -3.0});
  bench.run(0.5);
  const double share = std::sqrt(0.5);
  CHECK(bench.velocity().forward == Approx(share * 0.5 * 0.76));
  CHECK(bench.velocity().left == Approx(-share * 0.5 * 0.76));
  bench.run(1.5);
  CHECK(std::hypot(bench.velocity().forward, bench.velocity().left) == Approx(1.0));
  CHECK(bench.pose().yaw == Approx(0.0).margin(1e-12));
}

TEST_CASE("a holonomic base steps sideways without turning", "[sim][drive]") {
  Bench bench(base_of(DriveKind::holonomic), Realism::ideal);
  bench.drive({.left = 0.0076});  // Reached in one tick.
  bench.run(10.0);
  CHECK(bench.pose().x == Approx(0.0).margin(1e-12));
  CHECK(bench.pose().y == Approx(0.076).margin(1e-12));
  CHECK(bench.pose().yaw == Approx(0.0).margin(1e-12));
}

TEST_CASE("each kind of base follows the exact arc of its velocity", "[sim][drive]") {
  const DriveKind kind = GENERATE(from_range(std::begin(kAll), std::end(kAll)));
  Twist2 velocity{.forward = 0.004, .turn_rate = 0.04};
  if (kind == DriveKind::holonomic) velocity.left = 0.005;
  Bench bench(base_of(kind), Realism::ideal);
  bench.drive(velocity);
  bench.run(20.0);
  const Complex end = integrated(velocity, 20.0);
  CHECK(bench.pose().yaw == Approx(0.8).margin(1e-12));
  CHECK(bench.pose().x == Approx(end.real()).margin(1e-12));
  CHECK(bench.pose().y == Approx(end.imag()).margin(1e-12));
}

TEST_CASE("the body of a synchro base keeps its direction while the wheels steer", "[sim][drive]") {
  Bench bench(base_of(DriveKind::synchro), Realism::ideal);
  bench.drive({.turn_rate = 0.04});
  bench.run(10.0);
  CHECK(bench.pose() == Pose2{0.0, 0.0, bench.pose().yaw});
  CHECK(bench.pose().yaw == Approx(0.4).margin(1e-12));
  CHECK(bench.body() == Pose2{});
  bench.drive({.forward = 0.0076});
  bench.run(0.01);
  bench.run(9.99);
  CHECK(bench.pose().x == Approx(0.076 * std::cos(0.4)).margin(1e-9));
  CHECK(bench.pose().y == Approx(0.076 * std::sin(0.4)).margin(1e-9));
  CHECK(bench.body().yaw == Approx(0.0).margin(1e-12));
}

TEST_CASE("the bodies of the other bases turn with them", "[sim][drive]") {
  const DriveKind kind = GENERATE(DriveKind::differential, DriveKind::holonomic);
  Bench bench(base_of(kind), Realism::nominal);
  bench.drive({.forward = 0.1, .turn_rate = 0.3});
  bench.run(3.0);
  CHECK(bench.body() == bench.pose());
}

TEST_CASE("a base that cannot move sideways refuses to, and keeps its former command", "[sim][drive]") {
  const DriveKind kind = GENERATE(DriveKind::differential, DriveKind::synchro);
  Bench bench(base_of(kind), Realism::ideal);
  bench.drive({.forward = 0.1});
  const orca::Status refused = bench.world.set_velocity_command(bench.id, {.forward = 0.3, .left = 0.1});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == orca::Code::failed_precondition);
  CHECK_THAT(refused.error().text(), Contains("cannot move sideways"));
  bench.run(1.0);
  CHECK(bench.velocity().forward == Approx(0.1));
  CHECK(bench.velocity().left == 0.0);
  CHECK_FALSE(bench.world.set_velocity_command(bench.id, {.left = std::nan("")}));
}

TEST_CASE("a wall stops a synchro base, but not the steering of its wheels", "[sim][drive][contact]") {
  Bench bench(base_of(DriveKind::synchro), Realism::ideal, {4.0, 3.0, 0.0});
  bench.drive({.forward = 0.5});
  bench.run(5.0);
  CHECK(bench.pose().x == Approx(5.0 - 0.205).margin(0.005));
  CHECK(std::fabs(bench.velocity().forward) < 0.01);
  bench.drive({.turn_rate = 1.0});
  bench.run(3.0);
  CHECK(wrapped(bench.pose().yaw - bench.body().yaw) > 2.5);
  bench.drive({.forward = 0.5});
  bench.run(2.0);
  CHECK(bench.pose().x < 4.5);  // It has gone back the way the wheels point.
}

TEST_CASE("a wall beside a holonomic base stops its motion to that side", "[sim][drive][contact]") {
  Bench bench(base_of(DriveKind::holonomic), Realism::ideal, {0.0, 4.0, 0.0});
  bench.drive({.left = 0.5});
  bench.run(5.0);
  CHECK(bench.pose().y == Approx(5.0 - 0.205).margin(0.005));
  CHECK(std::fabs(bench.velocity().left) < 0.01);
  CHECK(bench.contacts == 1);
}

TEST_CASE("at ideal realism the odometry of each kind of base is exact", "[sim][odometry]") {
  const DriveKind kind = GENERATE(from_range(std::begin(kAll), std::end(kAll)));
  const Pose2 start{-1.0, 1.0, 0.7};
  Bench bench(base_of(kind), Realism::ideal, start);
  const double left = kind == DriveKind::holonomic ? 0.2 : 0.0;
  for (const Twist2& velocity :
       {Twist2{0.4, left, 0.5}, Twist2{-0.1, -left, 1.5}, Twist2{0.3, 0.5 * left, -0.8}}) {
    bench.drive(velocity);
    bench.run(4.0);
  }
  REQUIRE(bench.contacts == 0);
  const Pose2 believed = start * bench.world.odometry(bench.id).value().pose;
  CHECK(norm(believed.position() - bench.pose().position()) < 1e-9);
  CHECK(wrapped(believed.yaw - bench.pose().yaw) == Approx(0.0).margin(1e-9));
}
