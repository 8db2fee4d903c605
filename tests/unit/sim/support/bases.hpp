// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"

namespace orca::sim::test {

/// Returns the Scout with another kind of drive.
inline RobotModel base_of(DriveKind kind) {
  RobotModel model = scout();
  model.drive.kind = kind;
  model.odometer = Odometer{World::kTick};
  return model;
}

/// One robot in the test room, driven by the test.
struct Bench {
  Bench(const RobotModel& model, Realism realism, Pose2 start = {})
      : world(test_room(), {.seed = 1, .realism = realism}) {
    const auto added = world.add_robot("dewey", model, start);
    REQUIRE(added);
    id = *added;
  }

  void drive(const Twist2& velocity) { REQUIRE(world.set_velocity_command(id, velocity)); }
  void stop() { world.emergency_stop(id); }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) {
      world.step();
      contacts += world.contacts().size();
    }
  }
  [[nodiscard]] Pose2 pose() const { return world.pose(id); }
  [[nodiscard]] Pose2 body() const { return world.body_pose(id); }
  [[nodiscard]] Twist2 velocity() const { return world.velocity(id); }
  /// What the encoders report, which the controller regulates: the velocity without the errors of the wheels.
  [[nodiscard]] Twist2 rolled() const { return world.odometry(id).value().velocity; }

  World world;
  RobotId id{};
  std::size_t contacts = 0;
};

}  // namespace orca::sim::test
