// SPDX-License-Identifier: GPL-3.0-or-later
// The choice of a velocity by the sets and the objective function of the paper (see window.hpp).
#include "dwa/window.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"

using namespace orca::dwa;
using orca::Pose2;
using orca::Twist2;
using orca::Vec2;

namespace {

constexpr Settings kSettings{
    .robot = {.max_speed = 0.5, .max_turn_rate = 1.0, .acceleration = 0.5, .turn_acceleration = 2.0},
    .weights = {.heading = 2.0, .distance = 2.0, .speed = 0.2},
    .interval = 0.25,
    .reaction = 0.1,
    .far = 0.8,
    .body = {.half_length = 0.25, .half_width = 0.21, .radius = 0.33},
    .margin = 0.1,
    .least_margin = 0.05};
constexpr double kLeaveWay = 0.3;
constexpr Vec2 kAhead{10.0, 0.0};

std::vector<Vec2> wall(double distance, double right, double left) {
  std::vector<Vec2> echoes;
  for (double y = right; y <= left + 1e-9; y += 0.05) echoes.push_back({distance, y});
  return echoes;
}

std::vector<Vec2> all_round(double distance) {
  std::vector<Vec2> echoes;
  for (int i = 0; i < 72; ++i) echoes.push_back(distance * orca::direction(i * std::numbers::pi / 36));
  return echoes;
}

std::vector<Vec2> seen_by(const Pose2& robot, const std::vector<Vec2>& places) {
  std::vector<Vec2> echoes;
  for (const Vec2 place : places) echoes.push_back(seen_from(robot, place));
  return echoes;
}

double smallest_gap(const Pose2& robot, const std::vector<Vec2>& places) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Vec2 place : places)
    smallest = std::min(smallest, orca::avoid::gap(seen_from(robot, place), kSettings.body));
  return smallest;
}

struct Drive {
  bool arrived = false;
  double clearance = std::numeric_limits<double>::infinity();
};

// Drives a robot that obeys within its accelerations from the origin to a place.
Drive drive(const std::vector<Vec2>& places, Vec2 goal, double seconds) {
  constexpr double kLap = 0.05;
  Pose2 robot;
  Twist2 now;
  State state;
  Drive drive;
  for (double time = 0.0; time < seconds && !drive.arrived; time += kLap) {
    const std::vector<Vec2> echoes = seen_by(robot, places);
    const Vec2 target = seen_from(robot, goal);
    const Twist2 wanted = steer(now, {echoes, target, norm(target)}, kLeaveWay, kSettings, state);
    const double faster = kSettings.robot.acceleration * kLap;
    const double sharper = kSettings.robot.turn_acceleration * kLap;
    now.forward += std::clamp(wanted.forward - now.forward, -faster, faster);
    now.turn_rate += std::clamp(wanted.turn_rate - now.turn_rate, -sharper, sharper);
    robot = robot * moved(now, kLap);
    drive.clearance = std::min(drive.clearance, smallest_gap(robot, places));
    drive.arrived = norm(robot.position() - goal) < 0.2;
  }
  return drive;
}

}  // namespace

TEST_CASE("the window holds what the accelerations reach within the interval, and the turn rate 0", "[dwa]") {
  const Window window = window_around({0.3, 0.0, 0.2}, 0.5, kSettings);
  CHECK(window.speeds.front() == Approx(0.175));
  CHECK(window.speeds.back() == Approx(0.425));
  CHECK(window.turn_rates.front() == Approx(-0.3));
  CHECK(window.turn_rates.back() == Approx(0.7));
  CHECK(std::ranges::count(window.turn_rates, 0.0) == 1);
}

TEST_CASE("the window ends at the greatest speeds, and does not lead backwards", "[dwa]") {
  const Window fast = window_around({0.5, 0.0, 0.9}, 0.5, kSettings);
  CHECK(fast.speeds.back() == Approx(0.5));
  CHECK(fast.turn_rates.back() == Approx(1.0));
  CHECK(window_around({}, 0.5, kSettings).speeds.front() == 0.0);
  const Window too_fast = window_around({0.5, 0.0, 0.0}, 0.2, kSettings);  // It brakes as hard as it can.
  CHECK(too_fast.speeds.front() == Approx(0.375));
  CHECK(too_fast.speeds.back() == Approx(0.375));
}

TEST_CASE("an echo nearer than the margin does not keep the robot from leaving, but from coming nearer",
          "[dwa]") {
  const std::vector<Vec2> beside{{0.1, 0.23}};
  CHECK(room_on({0.2, 0.0, 0.0}, beside, kSettings).time > 1.0);
  CHECK(room_on({0.2, 0.0, 0.3}, beside, kSettings).time == 0.0);
  CHECK(room_on({0.2, 0.0, -0.3}, beside, kSettings).time > 0.5);
}

TEST_CASE("the faster the robot, the more margin it keeps", "[dwa]") {
  const std::vector<Vec2> narrow{{0.6, 0.285}, {0.6, -0.285}};
  CHECK(std::isinf(room_on({0.1, 0.0, 0.0}, narrow, kSettings).time));
  CHECK(room_on({0.5, 0.0, 0.0}, narrow, kSettings).time < 1.0);
}

TEST_CASE("the heading is best where the robot will point to the target after it has braked its turn",
          "[dwa]") {
  CHECK(heading({0.0, 0.0, 0.0}, kAhead, kSettings) == 1.0);
  CHECK(heading({0.0, 0.0, 0.0}, {-10.0, 0.0}, kSettings) == Approx(0.0));
  const double turned = 1.0 * kSettings.interval + 0.5 / kSettings.robot.turn_acceleration;
  CHECK(heading({0.0, 0.0, 1.0}, 10.0 * orca::direction(turned), kSettings) == Approx(1.0));
}

TEST_CASE("with nothing around DWA accelerates straight to its target", "[dwa]") {
  const auto best = best_velocity({0.3, 0.0, 0.0}, {{}, kAhead, std::nullopt}, 0.0, kSettings);
  REQUIRE(best);
  CHECK(best->turn_rate == 0.0);
  CHECK(best->forward == Approx(0.425));
}

TEST_CASE("DWA drives no faster than it can stop at its target", "[dwa]") {
  const auto best = best_velocity({0.3, 0.0, 0.0}, {{}, {0.09, 0.0}, 0.09}, 0.0, kSettings);
  REQUIRE(best);
  CHECK(best->forward <= std::sqrt(2.0 * 0.09 * kSettings.robot.acceleration) + 1e-9);
}

TEST_CASE("whatever is around, the best velocity is within reach and admissible", "[dwa]") {
  orca::RandomStream random(1, "test", "dwa");
  int chosen = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<Vec2> echoes;
    for (int k = 0; k < 15; ++k) {
      const Vec2 echo{random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2)};
      if (orca::avoid::gap(echo, kSettings.body) > 0.0) echoes.push_back(echo);
    }
    const Twist2 now{random.uniform(0.0, 0.5), 0.0, random.uniform(-1.0, 1.0)};
    const auto best = best_velocity(now, {echoes, kAhead, std::nullopt}, 0.0, kSettings);
    if (!best) continue;
    ++chosen;
    CHECK(can_stop(*best, room_on(*best, echoes, kSettings).time, kSettings.robot.brakes()));
    CHECK(std::abs(best->forward - now.forward) <= 0.125 + 1e-9);
    CHECK(std::abs(best->turn_rate - now.turn_rate) <= 0.5 + 1e-9);
  }
  CHECK(chosen > 150);
}

TEST_CASE("too fast before a wall DWA has no velocity, and brakes", "[dwa]") {
  const std::vector<Vec2> near = wall(0.42, -1.0, 1.0);
  const Twist2 fast{0.5, 0.0, 0.0};
  State state;
  CHECK_FALSE(best_velocity(fast, {near, kAhead, std::nullopt}, 0.0, kSettings));
  CHECK(steer(fast, {near, kAhead, std::nullopt}, kLeaveWay, kSettings, state) == Twist2{});
}

TEST_CASE("at rest before a wall DWA turns on the spot, and goes on to the same side", "[dwa]") {
  const std::vector<Vec2> near = wall(0.36, -0.6, 0.6);
  State state;
  Twist2 now;
  const Twist2 first = steer(now, {near, kAhead, std::nullopt}, kLeaveWay, kSettings, state);
  CHECK(first.forward == 0.0);
  CHECK(std::abs(first.turn_rate) > 0.1);
  for (int i = 0; i < 5; ++i) {
    now = steer(now, {near, kAhead, std::nullopt}, kLeaveWay, kSettings, state);
    CHECK(now.turn_rate * first.turn_rate > 0.0);
  }
}

TEST_CASE("closed in so that not even its corners can turn, DWA stands", "[dwa]") {
  const std::vector<Vec2> closed{{0.3, 0.0},   {0.28, 0.2},   {0.28, -0.2}, {0.2, 0.24},  {0.2, -0.24},
                                 {-0.2, 0.24}, {-0.2, -0.24}, {-0.28, 0.2}, {-0.28, -0.2}};
  State state;
  CHECK(steer({}, {closed, kAhead, std::nullopt}, kLeaveWay, kSettings, state) == Twist2{});
}

TEST_CASE("DWA reaches a target in the open, behind a box, between posts and behind it, and keeps clear",
          "[dwa]") {
  const std::vector<Vec2> posts{{1.0, 0.4}, {1.0, -0.4}, {2.0, 0.1}, {2.0, 1.0}, {2.8, -0.7}, {2.8, 0.8}};
  CHECK(drive({}, {3.0, 1.0}, 60.0).arrived);
  CHECK(drive({}, {-2.0, 0.1}, 60.0).arrived);
  for (const auto& places : {wall(1.5, -0.4, 0.4), posts}) {
    const Drive drove = drive(places, {4.0, 0.0}, 60.0);
    CHECK(drove.arrived);
    CHECK(drove.clearance > 0.02);
  }
}

TEST_CASE("in a closed ring DWA neither arrives nor touches it", "[dwa]") {
  const Drive drove = drive(all_round(1.2), {4.0, 0.0}, 30.0);
  CHECK_FALSE(drove.arrived);
  CHECK(drove.clearance > 0.0);
}
