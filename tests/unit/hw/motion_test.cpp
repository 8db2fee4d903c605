// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/hw/endpoints.hpp"

using namespace orca;
using namespace orca::hw;
using Catch::Contains;

namespace {

constexpr DriveLimits kLimits{
    .max_speed = 1.0, .max_turn_rate = 2.0, .steer_gain = 0.5, .big_turn_angle = 1.0, .big_turn_speed = 0.2};
constexpr Duration kAge = 200ms;
constexpr TimePoint kStart{1000s};
constexpr DriveSetpoint kStand{};
constexpr DriveSetpoint kStop{.at_once = true};

DriveSetpoint driving(double speed, double turn_rate) {
  return {.velocity = {.forward = speed, .turn_rate = turn_rate}};
}

// Returns the motion of a base with these limits right after the command.
DriveSetpoint carried_out(const Loan<idl::MotionCommand>& command, const DriveLimits& limits = kLimits) {
  MotionHW motion(limits, kAge);
  CHECK(motion.command(*command, kStart).ok());
  return motion.due(kStart);
}

DriveLimits omni() {
  DriveLimits limits = kLimits;
  limits.type = idl::HOLONOMIC;
  return limits;
}

Loan<idl::HolonomicVelocity> velocity(double forward, double left, double turn_rate) {
  auto made = make_object<idl::HolonomicVelocity>();
  made->speed(forward);
  made->left(left);
  made->turn_rate(turn_rate);
  return made;
}

}  // namespace

TEST_CASE("a base stands until the first command", "[hw][motion]") {
  MotionHW motion(kLimits, kAge);
  CHECK(motion.due(kStart) == kStand);
  CHECK(motion.expiry() == kForever);
}

TEST_CASE("a command within the limits is carried out as it is", "[hw][motion]") {
  CHECK(carried_out(turn(-1.5, 0.7)) == driving(0.7, -1.5));
  CHECK(carried_out(turn(1.5, -0.7)) == driving(-0.7, 1.5));
}

TEST_CASE("the base turns to a direction with its gain", "[hw][motion]") {
  CHECK(carried_out(head(0.8, 0.5)) == driving(0.5, 0.4));
}

TEST_CASE("no command makes the base faster than its limits", "[hw][motion]") {
  orca::RandomStream random(1, "test", "limits");
  for (int i = 0; i < 1000; ++i) {
    const double value = random.uniform(-10.0, 10.0);
    const double speed = random.uniform(-5.0, 5.0);
    for (const auto& setpoint : {carried_out(turn(value, speed)), carried_out(head(value, speed))}) {
      CHECK(std::abs(setpoint.velocity.forward) <= kLimits.max_speed);
      CHECK(std::abs(setpoint.velocity.turn_rate) <= kLimits.max_turn_rate);
      CHECK(setpoint.velocity.forward * speed >= 0.0);
      CHECK(setpoint.velocity.turn_rate * value >= 0.0);
    }
  }
}

TEST_CASE("a base with a big turn angle slows down for directions beyond it", "[hw][motion]") {
  CHECK(carried_out(head(0.99, 0.5)).velocity.forward == 0.5);
  CHECK(carried_out(head(1.01, 0.5)).velocity.forward == 0.2);
  CHECK(carried_out(head(-1.01, 0.5)).velocity.forward == 0.2);
  CHECK(carried_out(head(-1.01, 0.1)).velocity.forward == 0.1);
  DriveLimits without = kLimits;
  without.big_turn_angle = 0.0;
  CHECK(carried_out(head(3.0, 0.5), without).velocity.forward == 0.5);
}

TEST_CASE("a command that grows older than max_command_age expires to zero, and is counted", "[hw][motion]") {
  MotionHW motion(kLimits, kAge);
  REQUIRE(motion.command(*turn(0.1, 0.5), kStart).ok());
  CHECK(motion.expiry() == kStart + kAge);
  CHECK(motion.due(kStart + kAge - 1ns) == driving(0.5, 0.1));
  CHECK(motion.expired_count() == 0);
  CHECK(motion.due(kStart + kAge) == kStop);
  CHECK(motion.expired_count() == 1);
  CHECK(motion.expiry() == kForever);
  CHECK(motion.due(kStart + 2 * kAge) == kStop);
  CHECK(motion.expired_count() == 1);
}

TEST_CASE("each new command starts its own age", "[hw][motion]") {
  MotionHW motion(kLimits, kAge);
  for (int lap = 0; lap < 10; ++lap) REQUIRE(motion.command(*turn(0.0, 0.5), kStart + lap * 150ms).ok());
  CHECK(motion.due(kStart + 9 * 150ms + 199ms) == driving(0.5, 0.0));
  CHECK(motion.expired_count() == 0);
}

TEST_CASE("a full stop and halt stop the base at once, and a standing base has no command that can expire",
          "[hw][motion]") {
  MotionHW motion(kLimits, kAge);
  REQUIRE(motion.command(*turn(0.1, 0.5), kStart).ok());
  REQUIRE(motion.command(*full_stop(), kStart + 1ms).ok());
  CHECK(motion.due(kStart + 1ms) == kStop);
  REQUIRE(motion.command(*turn(0.1, 0.5), kStart + 2ms).ok());
  motion.halt();
  CHECK(motion.due(kStart + 2ms) == kStop);
  CHECK(motion.due(kStart + 1s) == kStop);
  CHECK(motion.expired_count() == 0);
}

TEST_CASE(
    "a base that is held stands whatever is commanded, and moves again only by a command after it is let go",
    "[hw][motion]") {
  MotionHW motion(kLimits, kAge);
  REQUIRE(motion.command(*turn(0.1, 0.5), kStart).ok());
  motion.hold("emergency stop");
  CHECK(motion.due(kStart + 1ms) == kStop);
  const Status refused = motion.command(*turn(0.1, 0.5), kStart + 2ms);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::unavailable);
  CHECK_THAT(refused.error().message, Contains("emergency stop"));
  CHECK(motion.command(*full_stop(), kStart + 3ms).ok());
  CHECK(motion.due(kStart + 3ms) == kStop);
  motion.let_go();
  CHECK(motion.due(kStart + 4ms) == kStop);
  REQUIRE(motion.command(*turn(0.1, 0.5), kStart + 5ms).ok());
  CHECK(motion.due(kStart + 5ms) == driving(0.5, 0.1));
}

TEST_CASE("a full stop is obeyed whatever its other fields hold", "[hw][motion]") {
  MotionHW motion(kLimits, kAge);
  REQUIRE(motion.command(*turn(0.1, 0.5), kStart).ok());
  auto stop = full_stop();
  stop->speed(std::numeric_limits<double>::quiet_NaN());
  stop->direction(std::numeric_limits<double>::infinity());
  CHECK(motion.command(*stop, kStart).ok());
  CHECK(motion.due(kStart) == kStop);
}

TEST_CASE("a speed of 0 is a command like others: the base comes to rest as gently as it slows down",
          "[hw][motion]") {
  MotionHW motion(kLimits, kAge);
  REQUIRE(motion.command(*turn(0.1, 0.5), kStart).ok());
  REQUIRE(motion.command(*turn(0.0, 0.0), kStart).ok());
  CHECK(motion.due(kStart) == kStand);
  REQUIRE(motion.command(*full_stop(), kStart).ok());
  CHECK(motion.due(kStart) == kStop);
  REQUIRE(motion.command(*turn(0.0, 0.0), kStart).ok());
  CHECK(motion.due(kStart) == kStand);
}

TEST_CASE("a command without an opinion is refused with what to do, and changes nothing", "[hw][motion]") {
  MotionHW motion(kLimits, kAge);
  REQUIRE(motion.command(*turn(0.1, 0.5), kStart).ok());
  const Status refused = motion.command(*dont_care(), kStart + 100ms);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::invalid_argument);
  CHECK_THAT(refused.error().text(), Contains("DONTCARE") && Contains("MotionCommandFuser"));
  CHECK(motion.due(kStart + 100ms) == driving(0.5, 0.1));
  CHECK(motion.expiry() == kStart + kAge);
}

TEST_CASE("a command with a number that is not finite, or a negative weight, is refused and changes nothing",
          "[hw][motion]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  MotionHW motion(kLimits, kAge);
  std::vector<Loan<idl::MotionCommand>> wrong;
  for (const double value : {nan, inf, -inf}) {
    wrong.push_back(turn(value, 0.5));
    wrong.push_back(turn(0.5, value));
    wrong.push_back(head(value, 0.5));
    wrong.push_back(head(0.5, value));
  }
  wrong.push_back(turn(0.5, 0.5, -1.0));
  wrong.push_back(turn(0.5, 0.5, nan));
  for (const auto& command : wrong) {
    const Status refused = motion.command(*command, kStart);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == Code::invalid_argument);
    CHECK(motion.due(kStart) == kStand);
  }
}

TEST_CASE("a holonomic base carries out a velocity with a sideways part", "[hw][motion]") {
  MotionHW motion(omni(), kAge);
  REQUIRE(motion.command(*velocity(0.3, -0.4, 0.5), kStart).ok());
  CHECK(motion.due(kStart) == DriveSetpoint{.velocity = {.forward = 0.3, .left = -0.4, .turn_rate = 0.5}});
  CHECK(motion.due(kStart + kAge) == kStop);
  CHECK(motion.expired_count() == 1);
}

TEST_CASE("a velocity faster than a holonomic base keeps its direction", "[hw][motion]") {
  MotionHW motion(omni(), kAge);
  REQUIRE(motion.command(*velocity(-3.0, 4.0, -9.0), kStart).ok());
  const DriveSetpoint setpoint = motion.due(kStart);
  CHECK(setpoint.velocity.forward == Approx(-0.6));
  CHECK(setpoint.velocity.left == Approx(0.8));
  CHECK(setpoint.velocity.turn_rate == -2.0);
}

TEST_CASE("a holonomic base takes motion commands too, and drives them without a sideways part",
          "[hw][motion]") {
  MotionHW motion(omni(), kAge);
  REQUIRE(motion.command(*velocity(0.1, 0.5, 0.0), kStart).ok());
  REQUIRE(motion.command(*turn(0.25, 0.5), kStart).ok());
  CHECK(motion.due(kStart) == driving(0.5, 0.25));
}

TEST_CASE("a base that cannot move sideways refuses a holonomic velocity and says what to send",
          "[hw][motion]") {
  for (const auto type : {idl::DIFFERENTIAL, idl::SYNCHRO}) {
    DriveLimits limits = kLimits;
    limits.type = type;
    MotionHW motion(limits, kAge);
    REQUIRE(motion.command(*turn(0.1, 0.5), kStart).ok());
    const Status refused = motion.command(*velocity(0.1, 0.0, 0.0), kStart);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == Code::failed_precondition);
    CHECK_THAT(refused.error().text(), Contains("cannot move sideways") && Contains("MotionCommand"));
    CHECK(motion.due(kStart) == driving(0.5, 0.1));
  }
}

TEST_CASE("a holonomic velocity with a number that is not finite is refused and changes nothing",
          "[hw][motion]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  MotionHW motion(omni(), kAge);
  for (const auto& wrong : {velocity(nan, 0, 0), velocity(0, nan, 0), velocity(0, 0, nan)}) {
    const Status refused = motion.command(*wrong, kStart);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == Code::invalid_argument);
    CHECK(motion.due(kStart) == kStand);
  }
}

TEST_CASE("a base belongs to the mission of its last command, even while it stands, until its use ends",
          "[hw][motion][missions]") {
  MotionHW motion(kLimits, kAge);
  CHECK(motion.mission() == 0);
  auto command = turn(0.1, 0.5);
  command->mission(7);
  REQUIRE(motion.command(*command, kStart).ok());
  CHECK(motion.mission() == 7);
  motion.obstruct("it touched a wall");
  CHECK(motion.mission() == 7);
  command = full_stop();
  command->mission(8);
  REQUIRE(motion.command(*command, kStart).ok());
  motion.halt();
  CHECK(motion.mission() == 8);
  motion.end_mission();
  CHECK(motion.mission() == 0);
}

TEST_CASE("a command that a base refuses does not change its mission", "[hw][motion][missions]") {
  MotionHW motion(kLimits, kAge);
  auto opinion = dont_care();
  opinion->mission(7);
  REQUIRE_FALSE(motion.command(*opinion, kStart).ok());
  CHECK(motion.mission() == 0);
}
