// SPDX-License-Identifier: GPL-3.0-or-later
// Items in a world: what sees and touches them, and that runs with them repeat.
#include <catch2/catch.hpp>

#include "gripper_scene.hpp"
#include "orca/base/hash.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using orca::Vec2;
using Words = std::vector<std::string>;

TEST_CASE("an item stands where the world has it, sensors see it up to its height", "[sim][item]") {
  Scene scene({can_at(0.5)});
  CHECK(scene.can() == can_at(0.5).pose);
  CHECK(scene.sight(0.05) == Approx(0.499 - kRadius));
  CHECK(scene.sight(0.2) > 3.0);
  CHECK_FALSE(scene.world.item_pose("tin"));
}

TEST_CASE("a sonar hears a low can from afar by the slanted way, and its cone passes above one that is near",
          "[sim][item][sonar]") {
  // The Scout's sonars are 0.3 m high: their cones reach down to the can's top at 0.81 m.
  const auto [ahead, heard] = GENERATE(table<double, bool>({{1.2, true}, {0.5, false}}));
  Scene scene({can_at(ahead)});
  while (!scene.world.sonar(scene.dewey)) scene.run(0.01);
  const SonarReading& front = scene.world.sonar(scene.dewey)->readings.at(0);
  const double level = kFront + ahead - kRadius - 0.19;
  const double slanted = std::sqrt(level * level + 0.18 * 0.18);
  CHECK((front.range == Approx(slanted).margin(1e-6)) == heard);
  CHECK((front.range > 2.0) == !heard);
}

TEST_CASE("a robot that drives into an item touches it by its name, and does not push it", "[sim][item]") {
  Scene scene({can_at(0.5)});
  scene.drive(0.3, 4.0);
  CHECK(scene.touched == Words{"can"});
  CHECK(scene.world.pose(scene.dewey).x == Approx(kStart.x + 0.5 - kRadius).margin(1e-3));
  CHECK(scene.can() == can_at(0.5).pose);
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
  const GripperOrder close{Paddles::close, Lift::stay};
  CHECK(hash(can_at(0.06), close, 1.0) != hash(can_at(0.07), close, 1.0));
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
