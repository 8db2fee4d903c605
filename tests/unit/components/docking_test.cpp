// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>

#include "dock/docking.hpp"
#include "orca/base/portable_math.hpp"

using namespace orca;
using namespace orca::dock;
using Catch::Contains;

namespace {

constexpr Manner kManner{.speed = 0.05, .back_off = 0.4, .patience = 4.0, .attempts = 3};
constexpr double kLap = 0.05;   // [s]
constexpr double kFront = 0.2;  // [m] from the middle of the robot

/// A robot before contacts at the origin, with a wall behind them.
struct Bay {
  Pose2 robot{-0.8, 0.0, 0.0};
  double wall = 0.02;   // [m] where it is held
  double plate = 0.03;  // [m] half the width of the contacts
  bool is_on = true;
  int touches = 0;
  double fastest = 0.0;  // [m/s] at which it came to the wall
  double time = 0.0;
  double motors_held = 0.0;  // [s] for which nothing moves, from 5 s on

  [[nodiscard]] bool is_held() const { return robot.x + kFront >= wall; }
  [[nodiscard]] bool charges() const {
    return is_on && is_held() && std::fabs(robot.y + kFront * portable::sin(robot.yaw)) <= plate;
  }

  void drive(const Step& step) {
    const bool was_held = is_held();
    robot.yaw = wrapped(robot.yaw + kLap * step.turn_rate);
    if (step.speed < 0.0 || !was_held) {
      robot.x += kLap * step.speed * portable::cos(robot.yaw);
      robot.y += kLap * step.speed * portable::sin(robot.yaw);
    }
    if (is_held() && !was_held) {
      ++touches;
      fastest = std::max(fastest, std::fabs(step.speed));
    }
    time += kLap;
  }

  Step dock() {
    Docking docking;
    while (time < 600.0) {
      const bool stands = time >= 5.0 && time < 5.0 + motors_held;
      if (stands) docking.delay(kLap);
      const Step step = docking.step(robot, charges(), time, kManner);
      if (step.kind != Step::Kind::goes_on) return step;
      drive(stands ? Step{} : step);
    }
    return {};
  }
};

}  // namespace

TEST_CASE("a robot before a charger creeps to its contacts, from beside their axis too", "[dock]") {
  const double off = GENERATE(-0.1, -0.05, 0.0, 0.1);
  const double askew = GENERATE(-0.1, 0.0, 0.1);
  Bay bay{.robot = {-0.8, off, askew}};
  CHECK(bay.dock().kind == Step::Kind::done);
  CHECK(bay.charges());
  CHECK(bay.touches == 1);
  CHECK(bay.fastest == kManner.speed);
  CHECK(bay.time < 25.0);
}

TEST_CASE("a robot that stands far beside the axis gets to it in another attempt", "[dock]") {
  Bay bay{.robot = {-0.25, 0.25, 0.0}, .plate = 0.02};
  CHECK(bay.dock().kind == Step::Kind::done);
  CHECK(bay.touches == 2);
}

TEST_CASE("a charger that does not charge is given up after as many attempts as there may be, away from it",
          "[dock]") {
  Bay bay{.is_on = false};
  const Step last = bay.dock();
  CHECK(last.kind == Step::Kind::failed);
  CHECK_THAT(last.reason, Contains("the battery is not charged there"));
  CHECK(bay.touches == 3);
  CHECK(bay.robot.x < -0.5);
}

TEST_CASE("contacts that nothing stands behind are looked for no farther than the middle of the robot",
          "[dock]") {
  Bay bay{.wall = 10.0};
  CHECK(bay.dock().kind == Step::Kind::failed);
  CHECK(bay.touches == 0);
}

TEST_CASE("a robot whose motors are held for minutes on its way to the contacts goes on afterwards",
          "[dock]") {
  Bay bay{.motors_held = 300.0};
  CHECK(bay.dock().kind == Step::Kind::done);
  CHECK(bay.touches == 1);
  CHECK(bay.time < 325.0);
}
