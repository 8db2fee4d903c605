// SPDX-License-Identifier: GPL-3.0-or-later
// The decisions of a CollisionMonitor.
#include "collision_monitor/braking.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"

using namespace orca;
using namespace orca::gate;
using collision::Post;
using collision::Solid;
using collision::SweptBody;

namespace {

const std::array kBox{Solid{{{-0.25, -0.2}, {0.25, -0.2}, {0.25, 0.2}, {-0.25, 0.2}}, 0.0, 0.0, 0.3}};
const Rules kRules{.gentle = {0.5, 2.0}, .hard = {3.0, 2.0}, .reaction = 0.3, .margin = 0.02};

Verdict judge_ahead(double gap, const Intent& intent) {
  const std::array posts{Post{{0.25 + gap, 0.0}}};
  return judge(SweptBody(kBox), posts, intent, kRules);
}

}  // namespace

TEST_CASE("a motion at its share stops where its arc ends", "[gate]") {
  RandomStream random(1, "test", "motions");
  for (int i = 0; i < 1000; ++i) {
    const Twist2 twist{random.uniform(-1.0, 1.0), i % 2 * random.uniform(-1.0, 1.0),
                       random.uniform(-2.0, 2.0)};
    const Brakes brakes{random.uniform(0.3, 3.0), random.uniform(0.5, 4.0)};
    const double reaction = random.uniform(0.05, 0.5);
    const double free = random.uniform(0.0, 2.0);
    const double share = share_to_stop(twist, free, reaction, brakes);
    CAPTURE(twist.forward, twist.turn_rate, reaction, free, share);
    const double v = share * speed_of(twist), w = share * std::abs(twist.turn_rate);
    const double way = v * reaction + 0.5 * v * v / brakes.deceleration;
    const double turn = w * reaction + 0.5 * w * w / brakes.turn_deceleration;
    CHECK(way <= speed_of(twist) * free + 1e-9);
    CHECK(turn <= std::abs(twist.turn_rate) * free + 1e-9);
    const bool uses_all =
        way > speed_of(twist) * free - 1e-9 || turn > std::abs(twist.turn_rate) * free - 1e-9;
    CHECK((share == 1.0 || uses_all));
  }
}

TEST_CASE("a robot that moves sideways is stopped before what is beside it, and by nothing ahead", "[gate]") {
  const std::array beside{Post{{0.0, 0.25}}};
  const std::array ahead{Post{{0.3, 0.0}}};
  const Intent left{{0.0, 0.5, 0.0}, {0.0, 0.5, 0.0}};
  const Verdict stopped = judge(SweptBody(kBox), beside, left, kRules);
  CHECK(stopped.share == 0.0);
  CHECK(stopped.at_once);
  CHECK(judge(SweptBody(kBox), ahead, left, kRules).share == 1.0);
}

TEST_CASE("a command into free floor passes", "[gate]") {
  CHECK(judge(SweptBody(kBox), {}, {{0.5, 0.0, 0.3}, {}}, kRules).share == 1.0);
  CHECK(judge_ahead(2.0, {{0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}}).share == 1.0);
}

TEST_CASE(
    "the nearer something is ahead, the slower a robot may drive to it, and it may not drive on at the "
    "margin",
    "[gate]") {
  double before = 1.0;
  for (const double gap : {0.4, 0.3, 0.2, 0.1, 0.05}) {
    const Verdict verdict = judge_ahead(gap, {{0.6, 0.0, 0.0}, {}});
    CAPTURE(gap);
    CHECK(verdict.post);
    CHECK(verdict.share < before);
    CHECK(verdict.share > 0.0);
    const double v = 0.6 * verdict.share;
    CHECK(std::abs(v * 0.3 + v * v / (2.0 * 0.5) - (gap - 0.02)) < 0.005);
    before = verdict.share;
  }
  CHECK(judge_ahead(0.021, {{0.6, 0.0, 0.0}, {}}).share == 0.0);
  CHECK(judge_ahead(0.01, {{0.6, 0.0, 0.0}, {}}).share == 0.0);
}

TEST_CASE("what touches the robot may be left, and nothing else", "[gate]") {
  for (const double gap : {0.01, 0.0, -0.02}) {
    CHECK(judge_ahead(gap, {{-0.3, 0.0, 0.0}, {}}).share == 1.0);
    CHECK(judge_ahead(gap, {{0.3, 0.0, 0.0}, {}}).share == 0.0);
  }
}

TEST_CASE("where only an emergency stop helps it is asked for, whatever the command", "[gate]") {
  const double stopping = 0.6 * 0.3 + 0.6 * 0.6 / (2.0 * 3.0);
  for (const double wanted : {0.6, 0.0, -0.3}) {
    CHECK(judge_ahead(stopping - 0.01, {{wanted, 0.0, 0.0}, {0.6, 0.0, 0.0}}).at_once);
    CHECK_FALSE(judge_ahead(stopping + 0.03, {{wanted, 0.0, 0.0}, {0.6, 0.0, 0.0}}).at_once);
  }
  CHECK_FALSE(judge_ahead(0.01, {{-0.3, 0.0, 0.0}, {}}).at_once);
}

TEST_CASE("a slow robot passes nearer to things than a fast one", "[gate]") {
  // A gap that leaves 1 cm on either side, and one that leaves 5 mm.
  const auto between = [](double room, double speed) {
    const std::array posts{Post{{0.26, 0.2 + room}}, Post{{0.26, -0.2 - room}}};
    return speed * judge(SweptBody(kBox), posts, {{speed, 0.0, 0.0}, {}}, kRules).share;
  };
  CHECK(between(0.021, 0.6) == Approx(0.6));
  CHECK(between(0.01, 0.6) == Approx(0.08));
  CHECK(between(0.01, 0.05) == Approx(0.05));
  CHECK(between(0.005, 0.6) < 0.05);
}
