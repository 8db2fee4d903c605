// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "follow_person/pursuit.hpp"
#include "orca/base/portable_math.hpp"

using namespace orca;
using namespace orca::follow;

namespace {

constexpr Manner kManner{.distance = 1.2, .max_speed = 0.9, .search = 10.0};
constexpr double kLap = 0.1;   // [s]
constexpr double kPace = 0.6;  // [m/s]

/// A robot on an empty floor, and a person who walks 5 m ahead and then to the left.
struct Floor {
  Pursuit pursuit{};
  Pose2 robot{};
  double time = 0.0;
  double walked = 0.0;  // [m]

  [[nodiscard]] Person person() const {
    if (walked < 5.0) return {1, {1.2 + walked, 0.0}, {kPace, 0.0}};
    return {1, {6.2, walked - 5.0}, {0.0, kPace}};
  }
  Step lap(const std::vector<Person>& people) {
    const Step step = pursuit.step(robot, people, time, kManner);
    robot.yaw = wrapped(robot.yaw + kLap * step.turn_rate);
    robot.x += kLap * step.speed * portable::cos(robot.yaw);
    robot.y += kLap * step.speed * portable::sin(robot.yaw);
    time += kLap;
    return step;
  }
  Step walk() {
    const Step step = lap({person()});
    walked += kLap * kPace;
    return step;
  }
};

}  // namespace

TEST_CASE("a robot follows a person at its distance, on the way that he took", "[follow]") {
  Floor floor;
  while (floor.walked < 10.0) {
    CHECK(floor.walk().kind == Step::Kind::follows);
    if (floor.time > 3.0) CHECK(norm(floor.person().place - floor.robot.position()) > 0.7);
    if (floor.time > 3.0) CHECK(norm(floor.person().place - floor.robot.position()) < 1.5);
    const double off = std::min(std::fabs(floor.robot.y), std::fabs(floor.robot.x - 6.2));
    CHECK(off < 0.3);
  }
}

TEST_CASE("a robot stands before a person who stands", "[follow]") {
  Floor floor;
  while (floor.walked < 3.0) (void)floor.walk();
  Person standing = floor.person();
  standing.velocity = {};
  for (int lap = 0; lap < 50; ++lap) (void)floor.lap({standing});
  CHECK(norm(standing.place - floor.robot.position()) == Approx(kManner.distance).margin(0.15));
}

TEST_CASE("a robot that sees nobody any more goes where he went, looks for him, and says that he is lost",
          "[follow]") {
  Floor floor;
  while (floor.walked < 3.0) (void)floor.walk();
  const Vec2 last = floor.person().place;
  Step step;
  while (floor.time < 30.0 && step.kind != Step::Kind::lost) step = floor.lap({});
  CHECK(step.kind == Step::Kind::lost);
  CHECK(floor.time == Approx(3.0 / kPace + kManner.search).margin(0.3));
  CHECK(floor.robot.x > last.x);
  CHECK(floor.lap({}).kind == Step::Kind::nobody);
}

TEST_CASE("who appears near where a person was seen last is taken for him, and somebody else is not",
          "[follow]") {
  Floor floor;
  while (floor.walked < 3.0) (void)floor.walk();
  for (int lap = 0; lap < 20; ++lap) (void)floor.lap({});
  const Person stranger{7, {0.0, -4.0}, {kPace, 0.0}};
  CHECK(floor.lap({stranger}).kind == Step::Kind::searches);
  const Person again{8, floor.person().place + Vec2{1.0, 0.5}, {kPace, 0.0}};
  CHECK(floor.lap({stranger, again}).kind == Step::Kind::follows);
}

TEST_CASE("a robot begins to follow who walks before it, and not who walks behind it or far away",
          "[follow]") {
  const Person behind{1, {-1.0, 0.0}, {kPace, 0.0}};
  const Person far{2, {4.0, 0.0}, {kPace, 0.0}};
  const Person before{3, {2.0, 1.0}, {0.0, kPace}};
  Floor floor;
  CHECK(floor.lap({behind, far}).kind == Step::Kind::nobody);
  CHECK(floor.lap({behind, far, before}).kind == Step::Kind::follows);
}
