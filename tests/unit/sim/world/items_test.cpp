// SPDX-License-Identifier: GPL-3.0-or-later
// Items in a world, and grippers that take them, carry them and put them down.
#include <catch2/catch.hpp>

#include <algorithm>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using Catch::Contains;
using orca::Pose2;
using orca::Vec2;
using Words = std::vector<std::string>;

namespace {

constexpr double kFront = 0.205;  // [m] From the robot's axis to the root of its paddles.
constexpr double kRadius = 0.033;
const Pose2 kStart{-2.0, 2.0, 0.0};

// A Scout with a gripper in front: 0.2 m between the paddles, which are 0.1 m long.
RobotModel gripping_scout() {
  RobotModel model = scout();
  Gripper& gripper = model.gripper.emplace();
  gripper.mount = {kFront, 0.0, 0.0};
  gripper.opening = 0.2;
  gripper.depth = 0.1;
  gripper.lift = 0.08;
  gripper.paddle_time = std::chrono::seconds{1};
  gripper.lift_time = std::chrono::seconds{1};
  return model;
}

// A can at a place in the frame of the gripper of a robot at kStart.
Item can_at(double ahead, double left = 0.0, double radius = kRadius, const std::string& name = "can") {
  return {name, radius, 0.12, {kStart.x + kFront + ahead, kStart.y + left, 0.0}};
}

WorldModel room_with(std::vector<Item> items) {
  WorldModel room = test_room();
  room.items = std::move(items);
  return room;
}

// Dewey at kStart in the test room, with items.
struct Scene {
  explicit Scene(std::vector<Item> items)
      : world(room_with(std::move(items)), {.seed = 1, .realism = Realism::ideal}),
        dewey(world.add_robot("dewey", gripping_scout(), kStart).value()) {}

  void order(Paddles paddles, Lift lift = Lift::stay) {
    REQUIRE(world.set_gripper_command(dewey, {paddles, lift}));
  }
  void drive(double forward, double seconds) {
    REQUIRE(world.set_velocity_command(dewey, forward, 0.0));
    run(seconds);
    REQUIRE(world.set_velocity_command(dewey, 0.0, 0.0));
    run(1.0);
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) {
      world.step();
      notes.insert(notes.end(), world.happened().begin(), world.happened().end());
      for (const ContactEvent& contact : world.contacts()) touched.push_back(contact.other);
    }
  }
  // Takes the can, and forgets what was noted of it.
  void take() {
    order(Paddles::close);
    run(1.0);
    REQUIRE(now().holds);
    notes.clear();
  }
  [[nodiscard]] GripperReading now() const { return world.gripper(dewey).value(); }
  [[nodiscard]] Pose2 can() const { return world.item_pose("can").value(); }
  // Returns how far a ray at that height sees along Dewey's start, past Dewey.
  [[nodiscard]] double sight(double height) const {
    return world.caster().cast({{kStart.x + kFront + 0.001, kStart.y}, {1.0, 0.0}, 20.0, height}).range;
  }

  World world;
  RobotId dewey;
  Words notes{};
  Words touched{};
};

}  // namespace

TEST_CASE("an item stands where the world has it, sensors see it up to its height", "[sim][item]") {
  Scene scene({can_at(0.5)});
  CHECK(scene.can() == can_at(0.5).pose);
  CHECK(scene.sight(0.05) == Approx(0.499 - kRadius));
  CHECK(scene.sight(0.2) > 3.0);
  CHECK_FALSE(scene.world.item_pose("tin"));
}

TEST_CASE("a robot that drives into an item touches it by its name, and does not push it", "[sim][item]") {
  Scene scene({can_at(0.5)});
  scene.drive(0.3, 4.0);
  CHECK(scene.touched == Words{"can"});
  CHECK(scene.world.pose(scene.dewey).x == Approx(kStart.x + 0.5 - kRadius).margin(1e-3));
  CHECK(scene.can() == can_at(0.5).pose);
}

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

TEST_CASE("the first centimetres of a can's way after it was let go may be taken again", "[sim][gripper]") {
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
  const auto [ahead, left, held] =
      GENERATE(Case{0.099, 0.0, true}, Case{0.101, 0.0, false}, Case{0.06, 0.099, true},
               Case{0.06, 0.101, false}, Case{0.06, -0.101, false});
  Scene scene({can_at(ahead, left)});
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
  Scene scene({can_at(0.08, 0.0, far_radius, "far"), can_at(0.025, 0.0, 0.02, "near")});
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

TEST_CASE("a picture shows items on the floor, and one that is held at the gripper", "[sim][item]") {
  Scene scene({can_at(0.06)});
  const auto cans = [&] {
    std::vector<Vec2> centers;
    for (const Circle& circle : scene.world.snapshot().circles)
      if (circle.radius == kRadius) centers.push_back(circle.center);
    return centers;
  };
  CHECK(cans() == std::vector{can_at(0.06).pose.position()});
  scene.take();
  REQUIRE(scene.world.place_robot(scene.dewey, {0.0, -2.0, 0.0}));
  CHECK(cans() == std::vector{scene.can().position()});
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

TEST_CASE("no obstacle takes the name or the place in the list of an item, held or not", "[sim][item]") {
  Scene scene({can_at(0.06)});
  const auto name_is_taken = [&] {
    const auto added = scene.world.add_obstacle("can", Circle{{}, 0.1}, 1.0, {0.0, -2.0, 0.0});
    return !added && added.error().code == orca::Code::already_exists;
  };
  CHECK(name_is_taken());
  CHECK(scene.world.remove_obstacle(ObstacleId{0}).error().code == orca::Code::not_found);
  CHECK(scene.world.move_obstacle(ObstacleId{0}, {}).error().code == orca::Code::not_found);
  scene.take();
  CHECK(name_is_taken());
}

TEST_CASE("the hash of a world tells where items are, what grippers do and who holds what", "[sim][item]") {
  const auto hash = [](const Item& item, const GripperOrder& order, double seconds) {
    Scene scene({item});
    scene.order(order.paddles, order.lift);
    scene.run(seconds);
    return scene.world.state_hash();
  };
  const std::uint64_t still = hash(can_at(0.06), {}, 0.5);
  CHECK(hash(can_at(0.06), {}, 0.5) == still);
  CHECK(hash(can_at(0.07), {}, 0.5) != still);
  CHECK(hash(can_at(0.06), {Paddles::close, Lift::stay}, 0.5) != still);
  CHECK(hash(can_at(0.06), {Paddles::stay, Lift::up}, 0.5) != still);
  // Another order counts before it shows.
  Scene scene({can_at(0.06)});
  const std::uint64_t before = scene.world.state_hash();
  scene.order(Paddles::close);
  CHECK(scene.world.state_hash() != before);
}

TEST_CASE("two worlds in which a robot fetches and carries are bit-identical", "[sim][item][repeat]") {
  const auto run = [] {
    WorldModel room = room_with({can_at(0.06), can_at(0.8, 0.3, 0.05, "tin")});
    World world(room, {.seed = 7, .realism = Realism::harsh});
    const RobotId dewey = world.add_robot("dewey", gripping_scout(), kStart).value();
    orca::Fnv1a trace;
    std::size_t taken = 0;
    for (int i = 0; i < 3000; ++i) {
      const bool closes = i % 500 < 250;
      REQUIRE(world.set_gripper_command(dewey, {closes ? Paddles::close : Paddles::open, Lift::stay}));
      REQUIRE(world.set_velocity_command(dewey, closes && i > 150 ? 0.3 : 0.0, 0.2));
      world.step();
      taken += world.gripper(dewey)->holds ? 1 : 0;
      for (const std::string& note : world.happened()) trace.add_text(note);
      trace.add_u64(world.state_hash());
    }
    CHECK(taken > 100);
    return trace.value();
  };
  CHECK(run() == run());
}
