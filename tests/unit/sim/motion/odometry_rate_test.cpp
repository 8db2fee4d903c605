// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using orca::Pose2;
using namespace orca::sim::test;

TEST_CASE("an odometer of 100 Hz reports every step of the simulation, stamped when it was measured",
          "[sim][odometry]") {
  RobotModel model = scout();
  model.odometer = Odometer{std::chrono::milliseconds{10}};
  World world({}, {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", model, {});
  REQUIRE(world.set_velocity_command(id, 0.5, 0.4));
  for (int i = 0; i < 500; ++i) {
    world.step();
    REQUIRE(world.odometry(id));
    CHECK(world.odometry(id)->stamp == world.time());
    const Pose2 pose = world.pose(id);
    CHECK(world.odometry(id)->pose.x == Approx(pose.x).margin(1e-6));
    CHECK(world.odometry(id)->pose.yaw == Approx(pose.yaw).margin(1e-6));
  }
}
