// SPDX-License-Identifier: GPL-3.0-or-later
// How a CollisionMonitor lets people pass.
#include "collision_monitor/crossing.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <deque>
#include <optional>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"

using namespace orca;
using namespace orca::gate;
using collision::Solid;
using collision::SweptBody;

namespace {

const std::array kBox{Solid{{{-0.25, -0.2}, {0.25, -0.2}, {0.25, 0.2}, {-0.25, 0.2}}, 0.0, 0.0, 0.3}};
const Rules kRules{.gentle = {0.5, 2.0}, .hard = {3.0, 4.0}, .reaction = 0.3, .margin = 0.02};
const Twist2 kOn{0.5, 0.0, 0.0};

Crossing decide(const Passer& passer, const Twist2& wanted = kOn, const Twist2& present = kOn) {
  return cross(SweptBody(kBox), std::array{passer}, {wanted, present}, kRules);
}

// A robot that wants to drive on, whose base takes up a command after 0.2 s, and somebody who walks on.
struct Meeting {
  Vec2 person;    // [m] in the world, in which the robot begins at the origin
  Vec2 velocity;  // [m/s]
  Pose2 robot{};
  Twist2 twist = kOn;

  struct End {
    std::optional<double> speed{};  // [m/s] of the robot when they touch, if they do
    double way = 0.0;               // [m] that it has gone
  };
  End run(double seconds) {
    constexpr double kStep = 0.1;
    const SweptBody body(kBox);
    std::deque<Twist2> commands(2, kOn);
    for (double time = 0.0; time < seconds; time += kStep) {
      const Vec2 seen = seen_from(robot, person);
      if (body.plan_distance(seen) < 0.3) return {std::fabs(twist.forward), robot.x};
      const Passer passer{seen, rotated(velocity, -robot.yaw), 0.3, 0.05, 0.1};
      const double share = cross(body, std::array{passer}, {kOn, twist}, kRules).share;
      commands.push_back({share * kOn.forward, 0.0, 0.0});
      const double aim = commands.front().forward;
      commands.pop_front();
      const double most = kStep * (aim == 0.0 ? kRules.hard : kRules.gentle).deceleration;
      twist.forward += std::clamp(aim - twist.forward, -most, most);
      robot = robot * moved(twist, kStep);
      person = person + kStep * velocity;
    }
    return {std::nullopt, robot.x};
  }
};

}  // namespace

TEST_CASE("among people who go elsewhere a command passes", "[gate][people]") {
  CHECK(cross(SweptBody(kBox), {}, {kOn, kOn}, kRules).share == 1.0);
  CHECK(decide({{2.0, 1.0}, {0.0, 1.2}}).share == 1.0);   // has passed
  CHECK(decide({{1.5, 0.0}, {1.2, 0.0}}).share == 1.0);   // walks on ahead
  CHECK(decide({{1.0, 1.5}, {-0.5, 0.0}}).share == 1.0);  // comes by at the side
}

TEST_CASE("somebody who crosses close ahead is let pass, and one who comes later is not waited for",
          "[gate][people]") {
  const Crossing now = decide({{0.9, -1.0}, {0.0, 1.2}});
  CHECK(now.share == 0.0);
  CHECK(now.who == 0U);
  CHECK(decide({{0.9, -5.0}, {0.0, 1.2}}).share == 1.0);
}

TEST_CASE("who stands in sight is none that passes", "[gate][people]") {
  CHECK(decide({{1.2, 0.0}, {0.0, 0.1}}).share == 1.0);
}

TEST_CASE("somebody beside the robot holds no motion away from him", "[gate][people]") {
  CHECK(decide({{0.0, 0.45}, {0.0, 0.3}}, kOn, {}).share == 1.0);
}

TEST_CASE("only an emergency stop helps if somebody is about to be touched", "[gate][people]") {
  CHECK(decide({{0.8, -0.5}, {0.0, 1.2}}).at_once);
  CHECK_FALSE(decide({{0.9, -2.5}, {0.0, 1.2}}).at_once);
}

TEST_CASE("a robot that knows who walks where stands whenever it is touched, and gets on", "[gate][people]") {
  RandomStream random(1, "test", "people");
  double way = 0.0;
  int untouched = 0;
  constexpr int kMeetings = 1000;
  for (int i = 0; i < kMeetings; ++i) {
    const Vec2 from = random.uniform(2.5, 6.0) * direction(random.uniform(-3.1, 3.1));
    const Vec2 aim{random.uniform(0.0, 3.0), random.uniform(-0.5, 0.5)};
    const Vec2 velocity = random.uniform(0.5, 1.5) / norm(aim - from) * (aim - from);
    const Meeting::End end = Meeting{from, velocity}.run(10.0);
    CAPTURE(i, from.x, from.y, velocity.x, velocity.y);
    CHECK(end.speed.value_or(0.0) <= 0.1);
    if (end.speed) continue;
    ++untouched;
    way += end.way;
  }
  CAPTURE(untouched);
  CHECK(untouched > kMeetings / 2);
  CHECK(way / untouched > 3.0);  // of 5 m
}
