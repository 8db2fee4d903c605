// SPDX-License-Identifier: GPL-3.0-or-later
// Grippers that take items, carry them and put them down.
#include <catch2/catch.hpp>

#include <algorithm>

#include "gripper_scene.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using Catch::Contains;
using orca::Pose2;
using orca::Vec2;
using Words = std::vector<std::string>;

TEST_CASE("closing paddles take the can between them, and stop at its width", "[sim][gripper]") {
  Scene scene({can_at(0.06, 0.04)});
  CHECK(scene.now().is_open);
  scene.order(Paddles::close);
  scene.run(0.6);
  CHECK(scene.now().paddles_move);
  CHECK_FALSE(scene.now().is_open);
  CHECK_FALSE(scene.now().holds);
  scene.run(0.4);
  const GripperReading reading = scene.now();
  CHECK(reading.holds);
  CHECK(reading.opening == Approx(2.0 * kRadius / 0.2));
  CHECK_FALSE(reading.is_closed);
  CHECK_FALSE(reading.paddles_move);
  CHECK(reading.stamp == scene.world.time());
  CHECK(scene.notes == Words{"dewey has taken 'can'"});
  CHECK(scene.touched.empty());
  // The paddles have pulled it to their middle.
  CHECK(scene.can().x == Approx(kStart.x + kFront + 0.06));
  CHECK(scene.can().y == Approx(kStart.y));
}

TEST_CASE("a can that is held is neither seen nor touched, and goes along", "[sim][gripper]") {
  Scene scene({can_at(0.06)});
  scene.take();
  CHECK(scene.sight(0.05) > 3.0);
  REQUIRE(scene.world.set_velocity_command(scene.dewey, 0.3, 0.4));
  for (int i = 0; i < 300; ++i) {
    scene.run(0.01);
    const Vec2 wanted = scene.world.body_pose(scene.dewey) * Vec2{kFront + 0.06, 0.0};
    REQUIRE(norm(scene.can().position() - wanted) < 1e-9);
  }
  CHECK(std::fabs(scene.world.pose(scene.dewey).yaw) > 0.5);
  CHECK(scene.touched.empty());
}

TEST_CASE("a can that a synchro base holds stays with the body while the wheels steer", "[sim][gripper]") {
  RobotModel base = gripping_scout();
  base.drive.kind = DriveKind::synchro;
  World world(room_with({can_at(0.06)}), {.seed = 1, .realism = Realism::ideal});
  const RobotId dewey = world.add_robot("dewey", base, kStart).value();
  REQUIRE(world.set_gripper_command(dewey, {Paddles::close, Lift::stay}));
  REQUIRE(world.set_velocity_command(dewey, 0.0, 0.5));
  for (int i = 0; i < 200; ++i) world.step();
  REQUIRE(world.gripper(dewey)->holds);
  CHECK(world.pose(dewey).yaw > 0.5);
  CHECK(norm(world.item_pose("can")->position() - can_at(0.06).pose.position()) < 1e-9);
}

TEST_CASE("opening paddles put the can on the floor where the robot has carried it", "[sim][gripper]") {
  Scene scene({can_at(0.06)});
  scene.take();
  scene.drive(0.3, 4.0);
  const Pose2 there = scene.can();
  CHECK(there.x > kStart.x + 1.0);
  scene.order(Paddles::open);
  scene.run(1.0);
  REQUIRE(scene.notes.size() == 1);
  CHECK_THAT(scene.notes[0], Contains("dewey has put down 'can' at (-0."));
  CHECK_THAT(scene.notes[0], Contains(", 2.00) m"));
  CHECK(scene.now().is_open);
  CHECK_FALSE(scene.now().holds);
  CHECK(scene.can() == there);
  CHECK(scene.sight(0.05) == Approx(there.x - kRadius - kStart.x - kFront - 0.001));
  scene.drive(0.1, 1.5);
  CHECK(scene.touched == Words{"can"});
  CHECK(scene.can() == there);
  scene.drive(-0.3, 3.0);
  CHECK(scene.can() == there);
}

TEST_CASE("a can that was put down can be taken again", "[sim][gripper]") {
  Scene scene({can_at(0.06)});
  for (int round = 0; round < 3; ++round) {
    scene.take();
    scene.order(Paddles::open);
    scene.run(1.0);
    CHECK_THAT(scene.notes.at(0), Contains("has put down"));
  }
}

TEST_CASE("a can at the root of the paddles can be put down again without a touch", "[sim][gripper]") {
  // It stands beside the round front of the body. Pulled straight to the middle it would stand in the body.
  Scene scene({can_at(0.012, 0.098, 0.03)});
  scene.take();
  scene.order(Paddles::open);
  scene.run(1.0);
  CHECK_THAT(scene.notes.at(0), Contains("has put down"));
  CHECK(scene.touched.empty());
}

TEST_CASE("a can that is let go above the floor drops", "[sim][gripper]") {
  Scene scene({can_at(0.06)});
  scene.take();
  scene.order(Paddles::stay, Lift::up);
  scene.run(1.0);
  CHECK(scene.now().lift == 1.0);
  CHECK(scene.now().holds);
  scene.order(Paddles::open);
  scene.run(1.0);
  CHECK(scene.notes == Words{"dewey has dropped 'can' at (-1.73, 2.00) m"});
  CHECK(scene.sight(0.05) == Approx(0.059 - kRadius));
}

TEST_CASE("raised paddles close above what stands on the floor", "[sim][gripper]") {
  const double up = GENERATE(0.4, 0.6);  // [s] Of 1 s.
  Scene scene({can_at(0.06)});
  scene.order(Paddles::stay, Lift::up);
  scene.run(up);
  scene.order(Paddles::close, Lift::halt);
  scene.run(1.2);
  CHECK(scene.now().lift == Approx(up));
  CHECK(scene.now().holds == (up < 0.5));
  CHECK(scene.now().is_closed == (up > 0.5));
  CHECK(scene.now().outer_beam == (up < 0.5));
}

TEST_CASE("paddles that halt before they reach the can do not take it", "[sim][gripper]") {
  Scene scene({can_at(0.06)});
  scene.order(Paddles::close);
  scene.run(0.5);
  scene.order(Paddles::halt);
  scene.run(1.0);
  CHECK(scene.now().opening == Approx(0.5));
  CHECK_FALSE(scene.now().holds);
  scene.order(Paddles::close);
  scene.run(0.3);
  CHECK(scene.now().holds);
}

TEST_CASE("what is wider than the open paddles is not taken", "[sim][gripper]") {
  const auto [radius, held] = GENERATE(table<double, bool>({{0.101, false}, {0.099, true}}));
  Scene scene({can_at(0.099, 0.09, radius)});
  scene.order(Paddles::close);
  scene.run(1.5);
  CHECK(scene.now().holds == held);
  CHECK(scene.now().is_closed != held);
  CHECK(scene.notes.size() == (held ? 1 : 0));
}

TEST_CASE("half-closed paddles that come around a wider item do not take it", "[sim][gripper]") {
  const auto [radius, held] = GENERATE(table<double, bool>({{0.051, false}, {0.049, true}}));
  Scene scene({can_at(0.09, 0.0, radius)});
  REQUIRE(scene.world.place_robot(scene.dewey, {kStart.x - 1.0, kStart.y, 0.0}));
  scene.order(Paddles::close);
  scene.run(0.5);
  scene.order(Paddles::halt);
  REQUIRE(scene.world.place_robot(scene.dewey, kStart));
  scene.order(Paddles::close);
  scene.run(1.0);
  CHECK(scene.now().holds == held);
  CHECK(scene.can() == can_at(0.09).pose);
}

TEST_CASE("only an item whose centre is between the paddles is taken", "[sim][gripper]") {
  struct Case {
    double ahead, left;
    bool held;
  };
  const auto [ahead, left, held] = GENERATE(
      Case{0.099, 0.0, true}, Case{0.101, 0.0, false}, Case{0.06, 0.099, true}, Case{0.06, 0.101, false},
      Case{0.06, -0.101, false}, Case{0.001, 0.099, true}, Case{-0.001, 0.099, false});
  Scene scene({can_at(ahead, left, 0.015)});
  scene.order(Paddles::close);
  scene.run(1.5);
  CAPTURE(ahead, left);
  CHECK(scene.now().holds == held);
  CHECK(scene.now().is_closed != held);
}

TEST_CASE("of two items the paddles hold the wider one, and of equal ones that at the root",
          "[sim][gripper]") {
  struct Case {
    double far_radius;
    std::string taken;
  };
  const auto [far_radius, taken] = GENERATE(Case{0.02, "near"}, Case{0.025, "far"});
  std::vector<Item> items{can_at(0.08, 0.0, far_radius, "far"), can_at(0.025, 0.0, 0.02, "near")};
  if (GENERATE(false, true)) std::ranges::reverse(items);
  Scene scene(items);
  scene.order(Paddles::close);
  scene.run(1.5);
  CHECK(scene.notes == Words{"dewey has taken '" + taken + "'"});
}

TEST_CASE("a beam is interrupted by an item across it", "[sim][gripper]") {
  // The beams are 0.025 and 0.075 m from the root.
  struct Case {
    double ahead, left;
    bool inner, outer;
  };
  const auto [ahead, left, inner, outer] =
      GENERATE(Case{0.15, 0.0, false, false}, Case{0.107, 0.0, false, true}, Case{0.109, 0.0, false, false},
               Case{0.059, 0.0, false, true}, Case{0.057, 0.0, true, true}, Case{0.041, 0.0, true, false},
               Case{0.06, 0.125, false, true}, Case{0.06, 0.135, false, false});
  Scene scene({can_at(ahead, left)});
  CAPTURE(ahead, left);
  CHECK(scene.now().inner_beam == inner);
  CHECK(scene.now().outer_beam == outer);
}

TEST_CASE("what is held interrupts the beams wherever the lift is", "[sim][gripper]") {
  Scene scene({can_at(0.07)});
  scene.take();
  scene.order(Paddles::stay, Lift::up);
  scene.run(1.0);
  CHECK(scene.now().outer_beam);
  CHECK_FALSE(scene.now().inner_beam);
}

TEST_CASE("nothing is put down in a wall: the paddles stay closed, once, until the robot has gone",
          "[sim][gripper]") {
  Scene scene({can_at(0.06)});
  scene.take();
  scene.drive(0.5, 16.0);  // To the east wall.
  REQUIRE(scene.touched == Words{"east"});
  scene.order(Paddles::open);
  scene.run(1.0);
  REQUIRE(scene.notes.size() == 1);
  CHECK_THAT(scene.notes[0], Contains("dewey cannot put down 'can' at (5.0") &&
                                 Contains(" m: obstacle 'east' is there; the paddles stay closed"));
  CHECK(scene.now().holds);
  CHECK(scene.now().opening == Approx(2.0 * kRadius / 0.2));
  scene.drive(-0.3, 1.0);
  CHECK(scene.now().holds);
  scene.order(Paddles::open);
  scene.run(1.0);
  CHECK_FALSE(scene.now().holds);
  CHECK_THAT(scene.notes.at(1), Contains("has put down 'can' at (4."));
}

TEST_CASE("nothing is put down in a robot or another thing", "[sim][gripper]") {
  Scene scene({can_at(0.06), can_at(1.06, 0.0, 0.02, "tin")});
  scene.take();
  SECTION("a robot") {
    REQUIRE(scene.world.add_robot("huey", scout(), {kStart.x, kStart.y - 1.0, 0.0}));
    REQUIRE(scene.world.place_robot(scene.dewey, {kStart.x - 0.45, kStart.y - 1.0, 0.0}));
    scene.order(Paddles::open);
    scene.run(0.1);
    CHECK_THAT(scene.notes.at(0), Contains("robot 'huey' is there"));
  }
  SECTION("an item") {
    REQUIRE(scene.world.place_robot(scene.dewey, {kStart.x + 0.95, kStart.y, 0.0}));
    scene.order(Paddles::open);
    scene.run(0.1);
    CHECK_THAT(scene.notes.at(0), Contains(": 'tin' is there"));
  }
  CHECK(scene.now().holds);
}

TEST_CASE("a robot that is carried off takes along what it holds", "[sim][gripper]") {
  Scene scene({can_at(0.06)});
  scene.take();
  REQUIRE(scene.world.place_robot(scene.dewey, {0.0, -2.0, 0.5 * std::numbers::pi}));
  CHECK(scene.can().x == Approx(0.0).margin(1e-9));
  CHECK(scene.can().y == Approx(-2.0 + kFront + 0.06));
  scene.order(Paddles::open);
  scene.run(0.1);
  CHECK(scene.notes == Words{"dewey has put down 'can' at (0.00, -1.73) m"});
}

TEST_CASE("of two robots that close on one can the first to be added takes it", "[sim][gripper]") {
  Scene scene({can_at(0.06)});
  const Pose2 opposite{kStart.x + 2.0 * (kFront + 0.06), kStart.y, std::numbers::pi};
  const RobotId huey = scene.world.add_robot("huey", gripping_scout(), opposite).value();
  REQUIRE(scene.world.set_gripper_command(huey, {Paddles::close, Lift::stay}));
  CHECK(scene.world.gripper(huey)->outer_beam == scene.now().outer_beam);
  scene.take();
  scene.run(0.5);
  CHECK(scene.world.gripper(huey)->is_closed);
  CHECK_FALSE(scene.world.gripper(huey)->holds);
  CHECK_FALSE(scene.world.gripper(huey)->outer_beam);
}

TEST_CASE("a robot without a gripper takes no orders for one", "[sim][gripper]") {
  Scene scene({});
  const RobotId huey = scene.world.add_robot("huey", scout(), {0.0, -2.0, 0.0}).value();
  const orca::Status refused = scene.world.set_gripper_command(huey, {Paddles::open, Lift::up});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == orca::Code::failed_precondition);
  CHECK_THAT(refused.error().message, Contains("has no gripper"));
  CHECK_FALSE(scene.world.gripper(huey));
}
