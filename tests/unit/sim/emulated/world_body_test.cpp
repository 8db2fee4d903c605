// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <vector>

#include "world_body.hpp"

using namespace orca;
using namespace orca::sim;
using namespace std::chrono_literals;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

RobotModel small_robot() {
  RobotModel robot;
  robot.sonars.push_back({});
  robot.sonars[0].count = 3;
  robot.lasers.push_back({});
  robot.lasers[0].first_angle = -1.0;
  robot.lasers[0].pitch = 0.5;
  robot.lasers[0].max_range = 8.0;
  robot.bumpers.push_back({});
  // Two in front, three behind.
  robot.bumpers[0].angles = {24 * kDegree, -24 * kDegree, -156 * kDegree, 180 * kDegree, 156 * kDegree};
  return robot;
}

SonarReading echo(std::size_t transducer, double range) { return {transducer, {}, {}, range, true}; }
SonarReading no_echo(std::size_t transducer) { return {transducer, {}, {}, 5.0, false}; }

struct Bench {
  RobotModel robot = small_robot();
  std::vector<Twist2> driven{};
  WorldBody body{robot, {.wheels = [this](const Twist2& velocity) { driven.push_back(velocity); }}};

  void sense(const SharedWorld::Inbox& inbox) { body.sense(inbox); }
  void turn_wheels(TimePoint at, const Twist2& velocity) {
    SharedWorld::Inbox inbox;
    inbox.odometry.push_back({at, {}, velocity});
    sense(inbox);
  }
};

}  // namespace

TEST_CASE("what firmware drives reaches the wheels of the world, and it reads what they did", "[emulated]") {
  Bench bench;
  bench.body.drive({0.4, 0.0, 0.1});
  REQUIRE(bench.driven.size() == 1);
  CHECK(bench.driven[0] == Twist2{0.4, 0.0, 0.1});
  SharedWorld::Inbox inbox;
  inbox.odometry.push_back({TimePoint{50ms}, {1.0, 2.0, 0.3}, {0.38, 0.0, 0.09}});
  bench.sense(inbox);
  CHECK(bench.body.odometry() == Pose2{1.0, 2.0, 0.3});
  CHECK(bench.body.velocity() == Twist2{0.38, 0.0, 0.09});
}

TEST_CASE("each sonar keeps what it heard last, and no echo is nothing", "[emulated]") {
  Bench bench;
  SharedWorld::Inbox inbox;
  inbox.sonar.push_back({0, {.readings = {echo(0, 1.5), no_echo(2)}}});
  bench.sense(inbox);
  CHECK(bench.body.sonar(0) == 1.5);
  CHECK(bench.body.sonar(1) == std::nullopt);
  CHECK(bench.body.sonar(2) == std::nullopt);
  inbox.sonar[0].second.readings = {echo(2, 0.7)};
  bench.sense(inbox);
  CHECK(bench.body.sonar(0) == 1.5);
  CHECK(bench.body.sonar(2) == 0.7);
  CHECK(bench.body.sonar(3) == std::nullopt);
  CHECK(bench.body.sonar(-1) == std::nullopt);
}

TEST_CASE("bumpers in front fill the low byte and those behind the high byte, in the file's order",
          "[emulated]") {
  Bench bench;
  SharedWorld::Inbox inbox;
  inbox.bumper.push_back({0, {{}, {false, true, true, false, true}, {}}});
  bench.sense(inbox);
  CHECK(bench.body.bumpers() == 0b0000'0101'0000'0010);
  inbox.bumper[0].second.pressed.assign(5, false);
  bench.sense(inbox);
  CHECK(bench.body.bumpers() == 0);
}

TEST_CASE("of a bumper that goes all around, each bit is a switch, counted from ahead to the left",
          "[emulated]") {
  RobotModel robot = small_robot();
  robot.bumpers[0].angles.clear();
  robot.bumpers[0].pitch = 60 * kDegree;
  WorldBody body(robot, {.wheels = [](const Twist2&) {}});
  SharedWorld::Inbox inbox;
  inbox.bumper.push_back({0, {{}, {true, false, false, true, false, true}, {}}});
  body.sense(inbox);
  CHECK(body.bumpers() == 0b10'1001);
}

TEST_CASE("a turn of the mirror has the scanner's beams, infinite where nothing came back", "[emulated]") {
  Bench bench;
  CHECK_FALSE(bench.body.last_turn());
  SharedWorld::Inbox inbox;
  inbox.laser.push_back({0, {.stamp = TimePoint{1s}, .ranges = {1.0, 8.0, 2.5}, .X_RB = {}}});
  bench.sense(inbox);
  const auto turn = bench.body.last_turn();
  REQUIRE(turn);
  CHECK(turn->stamp == TimePoint{1s});
  CHECK(turn->first_angle == -1.0);
  CHECK(turn->step == 0.5);
  REQUIRE(turn->ranges.size() == 3);
  CHECK(turn->ranges[0] == 1.0);
  CHECK(std::isinf(turn->ranges[1]));
  CHECK(turn->ranges[2] == 2.5);
}

TEST_CASE("wheels that do not turn for half a second though they should are stalled until they turn",
          "[emulated]") {
  Bench bench;
  bench.turn_wheels(TimePoint{0ms}, {});
  bench.body.drive({0.5, 0.0, 0.0});
  bench.turn_wheels(TimePoint{400ms}, {});
  CHECK_FALSE(bench.body.is_stalled());
  bench.turn_wheels(TimePoint{600ms}, {});
  CHECK(bench.body.is_stalled());
  bench.turn_wheels(TimePoint{700ms}, {});
  CHECK(bench.body.is_stalled());
  bench.turn_wheels(TimePoint{800ms}, {0.4, 0.0, 0.0});
  CHECK_FALSE(bench.body.is_stalled());
}

TEST_CASE("firmware moves the gripper of the world, and sees of it what its switches and beams would say",
          "[emulated][gripper]") {
  RobotModel robot = small_robot();
  robot.gripper.emplace();
  std::vector<GripperOrder> orders;
  WorldBody body(robot, {.wheels = [](const Twist2&) {},
                         .gripper = [&](const GripperOrder& order) { orders.push_back(order); }});
  body.move_gripper(emulators::GripperMove::close);
  body.move_gripper(emulators::GripperMove::stop_lift);
  REQUIRE(orders.size() == 2);
  CHECK(orders[0].paddles == Paddles::close);
  CHECK(orders[0].lift == Lift::stay);
  CHECK(orders[1].paddles == Paddles::stay);
  CHECK(orders[1].lift == Lift::halt);

  CHECK(body.gripper()->open);
  CHECK(body.gripper()->down);
  SharedWorld::Inbox inbox;
  GripperReading reading;
  reading.opening = 0.3;
  reading.lift = 1.0;
  reading.inner_beam = true;
  reading.holds = true;
  inbox.gripper.push_back(reading);
  body.sense(inbox);
  const auto look = body.gripper();
  CHECK_FALSE(look->open);
  CHECK(look->closed);  // on something
  CHECK(look->up);
  CHECK(look->inner_beam);
  CHECK((look->left_contact && look->right_contact));
}

TEST_CASE("a robot of the world without a gripper shows none, and moves none", "[emulated][gripper]") {
  Bench bench;
  bench.body.move_gripper(emulators::GripperMove::open);
  CHECK_FALSE(bench.body.gripper());
}
