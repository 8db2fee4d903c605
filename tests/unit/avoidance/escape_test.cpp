// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/avoidance/escape.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "orca/geometry/arc.hpp"

using orca::Pose2;
using orca::TimePoint;
using orca::Vec2;
using orca::avoid::Escape;
using orca::avoid::SeenFloor;
using std::numbers::pi;

namespace {

constexpr orca::nav::Footprint kCart{0.25, 0.2, 0.33};
constexpr double kTick = 0.05;  // [s]

// A robot that obeys, with an Escape that looks on.
struct Bot {
  Escape escape{kCart};
  SeenFloor floor;
  Pose2 pose{};
  double time = 0.0;
  bool turned = false;

  void drive_on(double way) {
    for (double left = way; left > 0.0; left -= 0.3 * kTick) lap({0.3, 0.0, 0.0}, 0.0, {});
  }

  // Stands but for what the escape wishes.
  void stand(double seconds, std::optional<double> goal, const std::vector<Vec2>& echoes = {}) {
    for (const double end = time + seconds; time < end;) lap({}, goal, echoes);
  }

  void lap(orca::Twist2 twist, std::optional<double> goal, const std::vector<Vec2>& echoes) {
    if (goal) *goal -= pose.yaw;
    const auto steer = escape.step({TimePoint{orca::from_seconds(time)}, pose, last, goal, echoes, floor});
    if (steer) twist = {steer->speed, 0.0, steer->turn_rate};
    turned = turned || twist.turn_rate != 0.0;
    pose = along_arc(pose, twist * kTick);
    last = twist;
    time += kTick;
  }

  orca::Twist2 last{};
};

}  // namespace

TEST_CASE(
    "a robot that has stood for a second, with a goal, backs off 0.1 m by the way that it has come, once",
    "[avoidance]") {
  Bot bot;
  bot.drive_on(1.0);
  const double touched = bot.pose.x;
  bot.stand(0.9, 0.0);
  CHECK(bot.pose.x == touched);
  bot.stand(20.0, 0.0);
  CHECK(bot.pose.x < touched - 0.09);
  CHECK(bot.pose.x > touched - 0.13);
  bot.drive_on(0.1);
  const double again = bot.pose.x;
  bot.stand(5.0, 0.0);
  CHECK(bot.pose.x < again - 0.09);
}

TEST_CASE("a robot without a goal may stand for as long as it likes", "[avoidance]") {
  Bot bot;
  bot.drive_on(1.0);
  const Pose2 there = bot.pose;
  bot.stand(20.0, std::nullopt);
  CHECK(bot.pose == there);
}

TEST_CASE("a robot that has not driven does not back off, but turns to its goal if its corners find room",
          "[avoidance]") {
  std::vector<Vec2> wall;
  for (double y = -0.5; y <= 0.5; y += 0.02) wall.push_back({0.27, y});
  Bot shut_in;
  shut_in.stand(20.0, 1.5, wall);
  CHECK(shut_in.pose == Pose2{});
  Bot ahead;
  ahead.stand(20.0, 0.0);
  CHECK(ahead.pose == Pose2{});
  const std::vector<double> ahead_only(181, 0.3);
  for (const bool has_laser : {true, false}) {
    Bot free;
    if (has_laser) free.floor.note({ahead_only, 0.1, 8.0, -pi / 2, pi / 180, {}}, {});
    free.stand(20.0, 1.5);
    CHECK(free.pose.position() == Vec2{});
    CHECK((free.pose.yaw > 1.2) == has_laser);
  }
}

TEST_CASE("it backs off no farther than it has driven, and not into what stands there now", "[avoidance]") {
  Bot bot;
  bot.drive_on(0.06);
  bot.stand(20.0, 0.0);
  CHECK(bot.pose.x > -0.04);
  Bot followed;
  followed.drive_on(1.0);
  const Pose2 there = followed.pose;
  followed.stand(20.0, 0.0, {Vec2{-0.26, 0.0}});
  CHECK(followed.pose.x == there.x);
}

TEST_CASE("a robot backs off over floor that its laser has seen to be free, and over no other",
          "[avoidance]") {
  const std::vector<double> ranges(360, 0.6);  // all around
  const double increment = pi / 180;
  for (const bool sees : {true, false}) {
    Bot bot;
    if (sees) bot.floor.note({ranges, 0.1, 8.0, -increment * 180, increment, {}}, {});
    bot.stand(5.0, 0.0);
    CHECK((bot.pose.x < -0.09) == sees);
  }
}

TEST_CASE("floor counts as seen before what a beam has met, in the field of view only", "[avoidance]") {
  std::vector<double> ranges(181, 2.0);
  ranges[90] = 1.0;
  ranges[130] = std::nan("");
  const double increment = pi / 180;
  SeenFloor floor;
  floor.note({ranges, 0.1, 8.0, -90 * increment, increment, {}}, {3.0, 0.0, 0.0});
  CHECK(floor.has({3.5, 0.0}));
  CHECK_FALSE(floor.has({4.1, 0.0}));
  const double silent = 40.0 * pi / 180;
  CHECK_FALSE(floor.has({3.0 + std::cos(silent), std::sin(silent)}));
  CHECK(floor.has({4.0, -1.0}));
  CHECK_FALSE(floor.has({2.5, 0.0}));
  floor.clear();
  CHECK_FALSE(floor.has({3.5, 0.0}));
}
