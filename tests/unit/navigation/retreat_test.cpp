// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/retreat.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "orca/geometry/arc.hpp"

using namespace orca::nav;
using orca::Pose2;
using orca::TimePoint;
using orca::Vec2;

namespace {

constexpr Footprint kCart{0.254, 0.215, 0.333};
constexpr Footprint kDisc{0.0, 0.0, 0.2};
constexpr double kMoment = 0.05;  // [s]

bool all_seen(Vec2 /*point*/) { return true; }
bool nothing_seen(Vec2 /*point*/) { return false; }

// Lets a retreat drive a robot from `pose` and returns where it has come to rest, or to after ten seconds.
// @param obeys  whether the robot moves as it should.
Pose2 driven(
    Retreat& retreat, Pose2 pose, const Retreat::Seen& seen, const std::vector<Vec2>& points = {},
    const std::function<bool(const Steer&)>& obeys = [](const Steer&) { return true; }) {
  retreat.begin();
  for (double time = 0.0; time < 10.0; time += kMoment) {
    const Steer steer =
        retreat.step(TimePoint{orca::from_seconds(time)}, {.pose = pose, .points = points}, seen);
    if (steer.blocked) break;
    if (obeys(steer)) pose = along_arc(pose, orca::Twist2{steer.speed, 0.0, steer.turn_rate} * kMoment);
  }
  return pose;
}

Steer first_step(const std::vector<Vec2>& points, const Footprint& footprint = kCart) {
  Retreat retreat(footprint);
  retreat.begin();
  return retreat.step({}, {.points = points}, all_seen);
}

// Notes a way along the x axis, up to the origin.
void come_from(Retreat& retreat, double x) {
  for (; x < 0.0; x += 0.01) retreat.note({x, 0.0, 0.0});
}

}  // namespace

TEST_CASE("a robot backs off over floor that it has seen, straight if that is as free as any arc",
          "[navigation]") {
  const Steer open = first_step({});
  CHECK(open.speed < 0.0);
  CHECK(open.turn_rate == 0.0);
  const std::vector aside{Vec2{-0.42, 0.15}};
  const Steer steer = first_step(aside);
  REQUIRE(steer.speed < 0.0);
  const auto room = [&](double curvature) {
    return room_along(kCart, {}, {-0.25, 0.0, -0.25 * curvature}, 5, aside, 0.01).share;
  };
  CHECK(room(steer.turn_rate / steer.speed) >= room(0.0));
}

TEST_CASE("a robot that has neither seen nor driven over the floor behind it does not back off",
          "[navigation]") {
  for (const Footprint& footprint : {kCart, kDisc}) {
    Retreat retreat(footprint);
    CHECK(driven(retreat, {1.0, 2.0, 0.5}, nothing_seen) == Pose2{1.0, 2.0, 0.5});
  }
}

TEST_CASE("it backs off no farther than it has come, or seen", "[navigation]") {
  for (const Footprint& footprint : {kCart, kDisc})
    for (const double way : {0.15, 0.4, 0.8}) {
      CAPTURE(footprint.half_length, way);
      Retreat retreat(footprint);
      come_from(retreat, -way);
      const Pose2 end = driven(retreat, {}, nothing_seen);
      CHECK(end.x < -way + 0.12);
      CHECK(end.x > -way - 0.04);
      Retreat other(footprint);
      const double tail = footprint.is_circle() ? footprint.radius : footprint.half_length;
      const Pose2 seen = driven(other, {}, [&](Vec2 point) { return point.x > -tail - way; });
      CHECK(seen.x < -way + 0.12);
      CHECK(seen.x >= -way);
    }
}

TEST_CASE("it follows the bend by which it has come, and stops before what stands there now",
          "[navigation]") {
  Retreat retreat(kCart);
  const auto place = [](double angle) { return Pose2{std::sin(angle), 1.0 - std::cos(angle), angle}; };
  for (double angle = -1.0; angle < 0.0; angle += 0.01) retreat.note(place(angle));
  const Pose2 end = driven(retreat, {}, nothing_seen);
  CHECK(std::abs(norm(end.position() - Vec2{0.0, 1.0}) - 1.0) < 0.03);
  CHECK(end.yaw < -0.7);
  CHECK(end.yaw > -1.05);
  Retreat stopped(kCart);
  come_from(stopped, -1.0);
  CHECK(driven(stopped, {}, nothing_seen, {Vec2{-0.6, 0.0}}).x > -0.6 + kCart.half_length);
}

TEST_CASE("where it cannot back off it goes forwards, if it sees that way", "[navigation]") {
  Retreat retreat(kCart);
  const auto ahead = [](Vec2 point) { return point.x > 0.2; };
  CHECK(driven(retreat, {}, ahead).x > 1.0);
  const std::vector behind{Vec2{-0.27, 0.15}, Vec2{-0.27, -0.15}, Vec2{-0.27, 0.0}};
  CHECK(first_step(behind).speed > 0.0);
}

TEST_CASE(
    "a robot that does not move backwards, because it touches what nobody sees, goes forwards, the next time "
    "at once",
    "[navigation]") {
  Retreat retreat(kCart);
  const auto ahead_only = [](const Steer& steer) { return steer.speed > 0.0; };
  CHECK(driven(retreat, {}, all_seen, {}, ahead_only).x > 1.0);
  retreat.begin();
  CHECK(retreat.step({}, {}, all_seen).speed > 0.0);
  retreat.reset();
  retreat.begin();
  CHECK(retreat.step({}, {}, all_seen).speed < 0.0);
}

TEST_CASE("a robot that moves in neither direction gives the retreat up", "[navigation]") {
  Retreat retreat(kCart);
  retreat.begin();
  int laps = 0;
  for (double time = 0.0; time < 10.0; time += kMoment, ++laps)
    if (retreat.step(TimePoint{orca::from_seconds(time)}, {}, all_seen).blocked) break;
  CHECK(laps * kMoment < 2.0);
}
