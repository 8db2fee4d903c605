// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/pure_pursuit.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"

using namespace orca::nav;
using orca::Pose2;
using orca::Vec2;

namespace {

constexpr Footprint kRobot{0.25, 0.2, 0.33};
constexpr Pursuit kPursuit{.max_speed = 1.0, .lateral_acceleration = 0.5, .deceleration = 1.0};

Path straight_on(double length) {
  const std::array points{Vec2{}, Vec2{length, 0.0}};
  return Path(points);
}

// Drives a robot that obeys at once, and returns its pose in the end.
Pose2 driven(const Path& path, Pose2 pose, double seconds) {
  constexpr double kTick = 0.02;
  double along = 0.0;
  Scene scene;
  for (double time = 0.0; time < seconds; time += kTick) {
    along = path.nearest(pose.position(), along, along + 0.5);
    scene.pose = pose;
    const Steer steer = follow(path, along, scene, kRobot, kPursuit, 0.0);
    scene.speed = steer.speed;
    scene.turning = steer.turning;
    pose = orca::along_arc(pose, {kTick * steer.speed, 0.0, kTick * steer.turn_rate});
  }
  return pose;
}

}  // namespace

TEST_CASE("the arc to a point begins along the robot's axis and ends there", "[navigation]") {
  orca::RandomStream random(11, "test", "points");
  for (int i = 0; i < 500; ++i) {
    const Vec2 point{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    const Arc arc = arc_to(point);
    const Pose2 end = orca::along_arc({}, {arc.length, 0.0, arc.curvature * arc.length});
    CAPTURE(point.x, point.y);
    CHECK(norm(end.position() - point) < 1e-9);
  }
  CHECK(arc_to({0.0, 1.0}).curvature == 2.0);
  CHECK(std::abs(arc_to({0.0, 1.0}).length - std::numbers::pi / 2) < 1e-12);
  CHECK(arc_to({1.5, 0.0}).length == 1.5);
}

TEST_CASE("a robot that drives at the speed to stop within a way stops at its end", "[navigation]") {
  for (const double way : {0.01, 0.1, 1.0, 5.0})
    for (const double delay : {0.0, 0.2, 1.0}) {
      const double speed = speed_to_stop_within(way, 0.5, delay);
      CHECK(std::abs(speed * delay + speed * speed / (2.0 * 0.5) - way) < 1e-9);
    }
  CHECK(speed_to_stop_within(-0.1, 0.5, 0.2) == 0.0);
}

TEST_CASE("on a straight path with nothing around it drives straight on at full speed", "[navigation]") {
  const Steer steer =
      follow(straight_on(10.0), 2.0, {.pose = {2.0, 0.0, 0.0}, .speed = 1.0}, kRobot, kPursuit, 0.0);
  CHECK(steer.speed == 1.0);
  CHECK(steer.turn_rate == 0.0);
}

TEST_CASE("beside a straight path it steers by the curvature of Coulter's equation", "[navigation]") {
  const Steer steer =
      follow(straight_on(10.0), 2.0, {.pose = {2.0, 0.1, 0.0}, .speed = 1.0}, kRobot, kPursuit, 0.0);
  const double look = 0.9;  // [m] its speed times look_ahead_time
  const double curvature = 2.0 * -0.1 / (look * look + 0.01);
  CHECK(std::abs(steer.turn_rate - curvature * steer.speed) < 1e-9);
}

TEST_CASE("it comes back to the path from beside it, and stops at its end", "[navigation]") {
  orca::RandomStream random(12, "test", "starts");
  for (int i = 0; i < 30; ++i) {
    const Pose2 start{0.0, random.uniform(-0.5, 0.5), random.uniform(-3.1, 3.1)};
    CAPTURE(i, start.y, start.yaw);
    CHECK(std::abs(driven(straight_on(20.0), start, 10.0).y) < 0.02);
    CHECK(norm(driven(straight_on(4.0), start, 30.0).position() - Vec2{4.0, 0.0}) < 0.1);
  }
}

TEST_CASE("it slows down in bends: the lateral acceleration stays within its limit", "[navigation]") {
  std::vector<Vec2> points;
  for (double angle = 0.0; angle < 6.0; angle += 0.05)
    points.push_back(0.5 * Vec2{std::sin(angle), 1.0 - std::cos(angle)});
  const Steer steer = follow(Path(points), 0.0, {.speed = 0.3}, kRobot, kPursuit, 1.0);
  CHECK(steer.speed * std::abs(steer.turn_rate) < kPursuit.lateral_acceleration + 1e-9);
  CHECK(steer.speed > 0.3);
  CHECK(steer.turn_rate > 0.0);
}

TEST_CASE("it slows down before a bend early enough for its brakes", "[navigation]") {
  const std::array points{Vec2{}, Vec2{10.0, 0.0}, Vec2{10.0, 5.0}};
  const Pursuit fast{.max_speed = 2.0, .deceleration = 0.4, .delay = 0.2};
  const auto speed_at = [&](double along, const Pursuit& pursuit) {
    const Scene scene{.pose = {along, 0.0, 0.0}, .speed = pursuit.max_speed};
    return follow(Path(points), along, scene, kRobot, pursuit, 0.0).speed;
  };
  CHECK(speed_at(4.0, fast) == 2.0);
  double before = 2.0;
  for (const double along : {5.5, 6.5, 7.5, 8.5}) {
    const double speed = speed_at(along, fast);
    CAPTURE(along);
    CHECK(speed < before);
    // From there it comes down to half a metre a second before the corner.
    CHECK(fast.delay * speed + (speed * speed - 0.25) / (2.0 * fast.deceleration) <= 10.0 - along + 1e-9);
    before = speed;
  }
  CHECK(speed_at(8.5, {.max_speed = 0.5, .deceleration = 0.4, .delay = 0.2}) == 0.5);
}

TEST_CASE("it drives the slower the nearer it passes obstacles", "[navigation]") {
  double before = 0.0;
  for (const double room : {0.05, 0.1, 0.15, 0.25}) {
    const std::array posts{Vec2{2.6, kRobot.half_width + room}};
    const Steer steer =
        follow(straight_on(10.0), 2.0, {.pose = {2.0, 0.0, 0.0}, .speed = 0.5, .points = posts}, kRobot,
               kPursuit, 0.0);
    CHECK(steer.speed > before);
    before = steer.speed;
  }
  CHECK(before == 1.0);
}

TEST_CASE("before something on the path it stops in time, and says that it is blocked", "[navigation]") {
  const std::array wall{Vec2{3.0, -0.1}, Vec2{3.0, 0.1}};
  const Path path = straight_on(10.0);
  Pose2 pose;
  Scene scene{.points = wall};
  bool blocked = false;
  for (int lap = 0; lap < 1000 && !blocked; ++lap) {
    scene.pose = pose;
    const Steer steer = follow(path, pose.x, scene, kRobot, kPursuit, 0.0);
    blocked = steer.blocked;
    // It slows down no faster than its deceleration allows.
    scene.speed = std::max(steer.speed, scene.speed - 0.02 * kPursuit.deceleration);
    pose.x += 0.02 * scene.speed;
  }
  CHECK(blocked);
  CHECK(pose.x + kRobot.half_length < 3.0);
  CHECK(pose.x + kRobot.half_length > 2.8);
}

TEST_CASE("to a path that begins behind it turns on the spot, the shorter way, if its corners find room",
          "[navigation]") {
  const Path path = straight_on(5.0);
  for (const double yaw : {-2.0, 2.0}) {
    const Pose2 here{0.0, 0.0, yaw};
    const Steer steer = follow(path, 0.0, {.pose = here}, kRobot, kPursuit, 0.0);
    CHECK(steer.turning);
    CHECK(steer.speed == 0.0);
    CHECK(steer.turn_rate * yaw < 0.0);
    const std::array post{here *
                          Vec2{0.0, 0.28}};  // farther away than half the width, nearer than the corners
    const Steer shut = follow(path, 0.0, {.pose = here, .points = post}, kRobot, kPursuit, 0.0);
    CHECK(shut.blocked);
    CHECK(shut.turn_rate == 0.0);
  }
}
