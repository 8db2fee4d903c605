// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "goto/algorithm.hpp"
#include "orca/base/random.hpp"

using namespace orca::go;
using Catch::Detail::Approx;
using orca::Pose2;
using orca::wrapped;
using std::numbers::pi;

namespace {

const Limits kLimits{.max_speed = 0.5,
                     .slow_down = 0.8,
                     .min_speed = 0.08,
                     .turn_in_place = 1.0,
                     .deceleration = 0.5,
                     .circle_radius = 0.6};
constexpr double kLap = 0.05;  // [s]

Target target_at(double x, double y) { return {.place = {x, y}, .reach_radius = 0.2}; }

Pose2 random_pose(orca::RandomStream& random) {
  return {random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(-pi, pi)};
}

// A pose that lies `distance` before the target and faces it.
Pose2 facing(const Target& target, double distance, double from_angle) {
  return {target.place.x - distance * std::cos(from_angle), target.place.y - distance * std::sin(from_angle),
          from_angle};
}

// Drives a point robot by the steps, a lap of 50 ms each; the turn rate is twice the direction asked for.
struct Drive {
  Pose2 pose;
  Before before{.time = kLap};

  Step lap(const Target& target) {
    const Step step = step_towards(target, pose, kLimits, before);
    before.near = step.near;
    before.speed = step.speed;
    if (step.kind == Step::Kind::reached) return step;
    pose.yaw = wrapped(pose.yaw + std::clamp(2.0 * step.direction, -1.0, 1.0) * kLap);
    pose.x += step.speed * std::cos(pose.yaw) * kLap;
    pose.y += step.speed * std::sin(pose.yaw) * kLap;
    return step;
  }

  Step follow(const Target& target) {
    Step step;
    for (int laps = 0; laps < 4000 && step.kind != Step::Kind::reached; ++laps) step = lap(target);
    return step;
  }
};

}  // namespace

TEST_CASE("a target without orientation is reached anywhere within its radius, and nowhere else",
          "[components][goto]") {
  orca::RandomStream random(2, "test", "reach");
  for (int i = 0; i < 1000; ++i) {
    const Pose2 pose = random_pose(random);
    Target target = target_at(random.uniform(-10, 10), random.uniform(-10, 10));
    target.reach_radius = random.uniform(0.0, 10.0);
    const bool inside = std::hypot(target.place.x - pose.x, target.place.y - pose.y) < target.reach_radius;
    CHECK((step_towards(target, pose, kLimits, {}).kind == Step::Kind::reached) == inside);
    CHECK(within_reach(target, pose) == inside);
  }
}

TEST_CASE(
    "a robot that slides moves straight at its goal however it stands, and turns to its orientation "
    "meanwhile",
    "[components][goto]") {
  orca::RandomStream random(3, "test", "slide");
  Limits limits = kLimits;
  limits.slides = true;
  for (int i = 0; i < 1000; ++i) {
    Target target = target_at(random.uniform(-10, 10), random.uniform(-10, 10));
    target.use_orientation = i % 2 == 0;
    target.orientation = random.uniform(-pi, pi);
    target.reach_angle = 0.1;
    const Pose2 from = random_pose(random);
    Pose2 pose = from;
    Before before{.time = kLap};
    Step step;
    double aside = 0.0;  // of the straight line
    const orca::Vec2 way = target.place - from.position();
    for (int laps = 0; laps < 4000 && step.kind != Step::Kind::reached; ++laps) {
      step = step_towards(target, pose, limits, before);
      before = {step.near, step.speed, kLap};
      const double rate = step.turn_rate ? *step.turn_rate : 2.0 * step.direction;
      const orca::Vec2 moved = step.speed * kLap * orca::direction(pose.yaw + step.direction);
      pose = {pose.x + moved.x, pose.y + moved.y, wrapped(pose.yaw + std::clamp(rate, -0.5, 0.5) * kLap)};
      aside = std::max(aside, std::abs(cross(way, pose.position() - from.position())) / norm(way));
    }
    CAPTURE(i);
    CHECK(step.kind == Step::Kind::reached);
    CHECK(within_reach(target, pose));
    CHECK(aside < 1e-6);
    if (target.use_orientation) CHECK(std::abs(wrapped(target.orientation - pose.yaw)) <= target.reach_angle);
  }
}

TEST_CASE("a target of radius zero is never reached, not even on the spot", "[components][goto]") {
  Target target = target_at(1.0, 2.0);
  target.reach_radius = 0.0;
  CHECK(step_towards(target, {1.0, 2.0, 0.0}, kLimits, {}).kind != Step::Kind::reached);
}

TEST_CASE("a target with orientation is reached only when the robot faces it", "[components][goto]") {
  Target target = target_at(0.0, 0.0);
  target.use_orientation = true;
  target.orientation = 3.0;
  target.reach_angle = 0.1;
  CHECK(step_towards(target, {0.0, 0.0, 3.05}, kLimits, {}).kind == Step::Kind::reached);
  CHECK(step_towards(target, {0.0, 0.0, -3.2}, kLimits, {}).kind == Step::Kind::reached);
  const Step step = step_towards(target, {0.0, 0.0, -3.0}, kLimits, {});
  CHECK(step.kind == Step::Kind::turn);
  CHECK(step.speed == 0.0);
  CHECK(step.direction == Approx(6.0 - 2 * pi));
}

TEST_CASE("a robot that drifts a little out of the radius while it turns goes on turning",
          "[components][goto]") {
  Target target = target_at(0.0, 0.0);
  target.use_orientation = true;
  target.reach_angle = 0.1;
  const Pose2 drifted{0.25, 0.0, 1.0};
  CHECK(step_towards(target, drifted, kLimits, {.near = true}).kind == Step::Kind::turn);
  CHECK(step_towards(target, drifted, kLimits, {.near = true}).direction == Approx(-1.0));
}

TEST_CASE("a target is never reached from outside its radius, however near the robot has been",
          "[components][goto]") {
  Target target = target_at(0.0, 0.0);
  for (const bool faces : {false, true}) {
    target.use_orientation = faces;
    target.orientation = pi;
    target.reach_angle = 0.1;
    for (const double off : {0.21, 0.29, 0.31, 3.0}) {
      const Step step = step_towards(target, {off, 0.0, pi}, kLimits, {.near = true});
      CAPTURE(faces, off);
      CHECK(step.kind == Step::Kind::drive);
      CHECK(step.speed >= kLimits.min_speed);
      CHECK_FALSE(step.near);
    }
  }
}

TEST_CASE("a robot that is pushed away from its goal while it turns comes back before it has arrived",
          "[components][goto]") {
  orca::RandomStream random(8, "test", "push");
  for (int i = 0; i < 100; ++i) {
    Target target = target_at(random.uniform(-10, 10), random.uniform(-10, 10));
    target.use_orientation = true;
    target.orientation = random.uniform(-pi, pi);
    target.reach_angle = 0.05;
    Drive drive{random_pose(random)};
    for (int laps = 0; laps < 4000 && !drive.before.near; ++laps) drive.lap(target);
    drive.pose.x += random.uniform(-1.0, 1.0);
    drive.pose.y += random.uniform(-1.0, 1.0);
    CAPTURE(i);
    CHECK(drive.follow(target).kind == Step::Kind::reached);
    CHECK(within_reach(target, drive.pose));
  }
}

TEST_CASE("before a via point a fast robot slows down to half a metre per second, at its deceleration",
          "[components][goto]") {
  Limits fast = kLimits;
  fast.max_speed = 2.0;
  Target via = target_at(3.0, 0.0);
  via.via = true;
  const auto speed = [&](double from_reach) {
    return step_towards(via, facing(via, via.reach_radius + from_reach, 0.0), fast, {}).speed;
  };
  CHECK(speed(0.001) == Approx(0.5).margin(0.01));
  CHECK(speed(0.75) == Approx(1.0));  // 1 - 0.5^2 = 2 * 0.5 * 0.75
  CHECK(speed(4.0) == 2.0);
}

TEST_CASE("a via point needs no orientation, and the robot does not slow down for it", "[components][goto]") {
  Target via = target_at(3.0, 0.0);
  via.via = true;
  via.use_orientation = true;
  via.orientation = 2.0;
  CHECK(step_towards(via, {2.9, 0.0, 0.0}, kLimits, {}).kind == Step::Kind::reached);
  for (const double distance : {0.21, 0.5, 5.0})
    CHECK(step_towards(via, facing(via, distance, 0.0), kLimits, {}).speed == kLimits.max_speed);
}

TEST_CASE("the speed never rises on the straight way to a goal, between its limits", "[components][goto]") {
  const Target target = target_at(1.0, -2.0);
  double last = kLimits.max_speed;
  for (double distance = 3.0; distance > 0.21; distance -= 0.01) {
    const Step step = step_towards(target, facing(target, distance, 0.7), kLimits, {});
    CHECK(step.kind == Step::Kind::drive);
    CHECK(step.speed <= last + 1e-12);
    CHECK(step.speed >= kLimits.min_speed - 1e-12);
    last = step.speed;
  }
  CHECK(last == Approx(0.8 * 0.21).epsilon(0.1));
}

TEST_CASE(
    "the direction is the bearing of the target in the robot frame, and the robot turns to a large one first",
    "[components][goto]") {
  orca::RandomStream random(3, "test", "direction");
  for (int i = 0; i < 1000; ++i) {
    const Pose2 pose = random_pose(random);
    const Target target = target_at(random.uniform(-10, 10), random.uniform(-10, 10));
    if (within_reach(target, pose)) continue;
    const Step step = step_towards(target, pose, kLimits, {});
    const double distance = std::hypot(target.place.x - pose.x, target.place.y - pose.y);
    CHECK(pose.x + distance * std::cos(pose.yaw + step.direction) == Approx(target.place.x).margin(1e-9));
    CHECK(pose.y + distance * std::sin(pose.yaw + step.direction) == Approx(target.place.y).margin(1e-9));
    CHECK((step.kind == Step::Kind::turn) == (std::abs(step.direction) > kLimits.turn_in_place));
    CHECK(step.speed >= 0.0);
    CHECK(step.speed <= kLimits.max_speed);
    if (step.kind == Step::Kind::turn) CHECK(step.speed == 0.0);
  }
}

TEST_CASE("the steps do not depend on where the world's axes lie", "[components][goto]") {
  orca::RandomStream random(4, "test", "frame");
  for (int i = 0; i < 200; ++i) {
    const Pose2 pose = random_pose(random);
    const Target target = target_at(random.uniform(-10, 10), random.uniform(-10, 10));
    const double turned = random.uniform(-pi, pi);
    const double c = std::cos(turned);
    const double s = std::sin(turned);
    const Pose2 turned_pose{c * pose.x - s * pose.y, s * pose.x + c * pose.y, wrapped(pose.yaw + turned)};
    const Step a = step_towards(target, pose, kLimits, {});
    const Step b = step_towards(
        target_at(c * target.place.x - s * target.place.y, s * target.place.x + c * target.place.y),
        turned_pose, kLimits, {});
    CHECK(b.kind == a.kind);
    CHECK(std::abs(wrapped(b.direction - a.direction)) < 1e-9);
    CHECK(b.speed == Approx(a.speed).margin(1e-9));
  }
}

TEST_CASE("a point robot arrives from anywhere, with the requested orientation", "[components][goto]") {
  orca::RandomStream random(5, "test", "arrive");
  for (int i = 0; i < 200; ++i) {
    Target target = target_at(random.uniform(-10, 10), random.uniform(-10, 10));
    target.use_orientation = true;
    target.orientation = random.uniform(-pi, pi);
    target.reach_angle = 0.1;
    Drive drive{random_pose(random)};
    CAPTURE(i);
    CHECK(drive.follow(target).kind == Step::Kind::reached);
    CHECK(std::abs(wrapped(drive.pose.yaw - target.orientation)) <= 0.1);
    CHECK(std::hypot(target.place.x - drive.pose.x, target.place.y - drive.pose.y) < 0.2 + 1e-9);
  }
}

TEST_CASE("within reach the robot comes to rest no harder than its deceleration, and only then has arrived",
          "[components][goto]") {
  orca::RandomStream random(6, "test", "rest");
  for (int i = 0; i < 100; ++i) {
    const Target target = target_at(random.uniform(-10, 10), random.uniform(-10, 10));
    Drive drive{random_pose(random)};
    double last = 0.0;
    Step step;
    for (int laps = 0; laps < 4000 && step.kind != Step::Kind::reached; ++laps) {
      last = step.speed;
      step = drive.lap(target);
      if (drive.before.near) CHECK(step.speed >= last - kLimits.deceleration * kLap - 1e-12);
    }
    REQUIRE(step.kind == Step::Kind::reached);
    CHECK(last <= kLimits.deceleration * kLap + 1e-12);
    CHECK(within_reach(target, drive.pose));
  }
}

TEST_CASE("the robot circles a target of radius zero counter-clockwise for ever, wherever it comes from",
          "[components][goto]") {
  orca::RandomStream random(7, "test", "circle");
  for (int i = 0; i < 20; ++i) {
    Target target = target_at(random.uniform(-3, 3), random.uniform(-3, 3));
    target.reach_radius = 0.0;
    Drive drive{random_pose(random)};
    for (int laps = 0; laps < 2000; ++laps) REQUIRE(drive.lap(target).kind != Step::Kind::reached);
    double around = 0.0;
    for (int laps = 0; laps < 2000; ++laps) {
      const double before = std::atan2(drive.pose.y - target.place.y, drive.pose.x - target.place.x);
      drive.lap(target);
      around += wrapped(std::atan2(drive.pose.y - target.place.y, drive.pose.x - target.place.x) - before);
      const double off = std::hypot(drive.pose.x - target.place.x, drive.pose.y - target.place.y);
      CHECK(off > 0.7 * kLimits.circle_radius);
      CHECK(off < 2.0 * kLimits.circle_radius);
    }
    CHECK(around > 6 * pi);
  }
}

TEST_CASE("the reach of a target is a ball: the higher above the robot, the smaller the reach on the floor",
          "[components][goto]") {
  Target target = target_at(0.0, 0.0);
  target.reach_radius = 0.5;
  target.rise = 0.3;
  CHECK(within_reach(target, {0.39, 0.0, 0.0}));
  CHECK_FALSE(within_reach(target, {0.41, 0.0, 0.0}));
  target.rise = -0.3;
  CHECK(within_reach(target, {0.39, 0.0, 0.0}));
  target.rise = 0.5;
  CHECK_FALSE(within_reach(target, {0.0, 0.0, 0.0}));
}
