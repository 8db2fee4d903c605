// SPDX-License-Identifier: GPL-3.0-or-later
// Where a robot goes to see what it has not seen, in rooms of echoes.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include "look_around/outlook.hpp"

using namespace orca;
using namespace orca::look;

namespace {

// A room of 4 m by 4 m around the origin, with a door of 1 m in the middle of its east wall; outside is nothing within sight.
bool is_wall(Vec2 at) {
  const bool at_east = std::fabs(at.x - 2.0) < 0.03 && std::fabs(at.y) <= 2.0 && std::fabs(at.y) > 0.5;
  const bool at_west = std::fabs(at.x + 2.0) < 0.03 && std::fabs(at.y) <= 2.0;
  return at_east || at_west || (std::fabs(std::fabs(at.y) - 2.0) < 0.03 && std::fabs(at.x) <= 2.0);
}

/// A robot in that room: what it sees within 5 m all around, and where its advice leads.
struct Robot {
  Pose2 X_OR;
  double turn_rate = 0.0;
  double time = 0.0;
  Outlook outlook;
  Limits limits{.body = {.robot_radius = 0.25,
                         .margin = 0.1,
                         .safe_distance = 0.8,
                         .stop_distance = 0.15,
                         .max_speed = 0.4,
                         .watches_goal = true}};

  explicit Robot(const Pose2& at) : X_OR(at) {}

  [[nodiscard]] std::vector<Vec2> echoes() const {
    std::vector<Vec2> seen;
    for (int i = 0; i < 360; ++i) {
      const Vec2 ahead = direction(i * std::numbers::pi / 180.0);
      for (double range = 0.02; range < 5.0; range += 0.02) {
        if (!is_wall(X_OR * (range * ahead))) continue;
        seen.push_back(range * ahead);
        break;
      }
    }
    return seen;
  }

  // A step of 0.1 s. Returns what was advised.
  std::optional<avoid::Advice> step() {
    const std::vector<Vec2> around = echoes();
    avoid::Situation situation;
    situation.heading = X_OR.yaw;
    const auto advice = outlook.step({time, X_OR, situation, around}, limits);
    time += 0.1;
    if (!advice) return advice;
    const double rate = advice->turn_rate.value_or(2.0 * advice->direction);
    const Vec2 at = X_OR.position() + 0.1 * advice->speed * direction(X_OR.yaw);
    X_OR = {at.x, at.y, wrapped(X_OR.yaw + 0.1 * rate)};
    return advice;
  }
};

}  // namespace

TEST_CASE("a panorama shows what is in front of the echoes, and nothing behind them", "[components][look]") {
  const Robot robot({0.5, 0.0, 1.0});
  const Panorama all(robot.X_OR, robot.echoes());
  CHECK(all.shows({1.5, 1.0}));
  CHECK(all.shows({-1.8, 0.0}));
  CHECK(all.shows({4.0, 0.0}));  // through the door
  CHECK_FALSE(all.shows({2.5, 1.5}));
  CHECK_FALSE(all.shows({-2.5, 0.0}));
}

TEST_CASE("in a doorway more is new than in a room that was seen", "[components][look]") {
  const Robot robot({0.5, 0.0, 1.0});
  const std::vector<Panorama> seen{{robot.X_OR, robot.echoes()}};
  CHECK(news_at({-1.0, 1.0}, seen) == 0);
  CHECK(news_at({1.0, -1.0}, seen) <= 2);
  CHECK(news_at({2.5, 0.0}, seen) >= 6);
}

TEST_CASE("a robot turns half round first, and then leaves the room by its door", "[components][look]") {
  for (const double yaw : {0.0, 2.0, -2.5}) {
    Robot robot({-0.5, 0.3, yaw});
    double turned = 0.0;
    for (int i = 0; i < 30; ++i) {
      const auto advice = robot.step();
      REQUIRE(advice);
      CHECK(advice->speed == 0.0);
      turned += 0.1 * advice->turn_rate.value_or(0.0);
    }
    CHECK(std::fabs(turned) == Approx(3.0).margin(0.05));
    bool is_out = false;
    for (int i = 0; i < 300 && !is_out; ++i) {
      (void)robot.step();
      is_out = robot.X_OR.x > 2.2;
      CHECK((robot.X_OR.x < 1.7 || std::fabs(robot.X_OR.y) < 0.3));  // in the middle of the door
    }
    INFO(yaw);
    CHECK(is_out);
  }
}

TEST_CASE("a robot that is told to begin anew turns again", "[components][look]") {
  Robot robot({-0.5, 0.3, 0.0});
  for (int i = 0; i < 60; ++i) (void)robot.step();
  robot.outlook.reset();
  const auto advice = robot.step();
  REQUIRE(advice);
  CHECK(advice->turn_rate);
  CHECK(advice->speed == 0.0);
}

TEST_CASE("a body without room to turn to either side does not turn its corners into what is there",
          "[components][look]") {
  Robot robot({-1.68, 0.0, 1.57});
  robot.limits.body.body = avoid::Rectangle{0.4, 0.25};
  robot.limits.body.robot_radius = std::hypot(0.4, 0.25);
  for (int i = 0; i < 100; ++i) {
    (void)robot.step();
    for (const double x : {-0.4, 0.4})
      for (const double y : {-0.25, 0.25}) CHECK((robot.X_OR * Vec2{x, y}).x > -2.0);
  }
}
