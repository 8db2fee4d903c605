// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"

namespace orca::sim::test {

inline constexpr double kFront = 0.205;   // [m] From the robot's axis to the root of its paddles.
inline constexpr double kRadius = 0.033;  // [m] Of a can.
inline const Pose2 kStart{-2.0, 2.0, 0.0};

/// A Scout with a gripper in front: 0.2 m between the paddles, which are 0.1 m long.
inline RobotModel gripping_scout() {
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

/// A can at a place in the frame of the gripper of a robot at kStart.
inline Item can_at(double ahead, double left = 0.0, double radius = kRadius,
                   const std::string& name = "can") {
  return {name, radius, 0.12, {kStart.x + kFront + ahead, kStart.y + left, 0.0}};
}

inline WorldModel room_with(std::vector<Item> items) {
  WorldModel room = test_room();
  room.items = std::move(items);
  return room;
}

/// Dewey at kStart in the test room, with items.
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
  /// Takes the can, and forgets what was noted of it.
  void take() {
    order(Paddles::close);
    run(1.0);
    REQUIRE(now().holds);
    notes.clear();
  }
  [[nodiscard]] GripperReading now() const { return world.gripper(dewey).value(); }
  [[nodiscard]] Pose2 can() const { return world.item_pose("can").value(); }
  /// Returns how far a ray at that height sees along Dewey's start, past Dewey.
  [[nodiscard]] double sight(double height) const {
    return world.caster().cast({{kStart.x + kFront + 0.001, kStart.y}, {1.0, 0.0}, 20.0, height}).range;
  }

  World world;
  RobotId dewey;
  std::vector<std::string> notes{};
  std::vector<std::string> touched{};
};

}  // namespace orca::sim::test
