// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using orca::Pose2;
using orca::wrapped;
using namespace orca::sim::test;

namespace {

constexpr auto kPeriod = std::chrono::milliseconds{100};

RobotModel scout_with_bumper() {
  BumperRing ring;
  ring.name = "bumper";
  ring.count = 8;
  ring.pitch = 45.0 * kDegree;
  ring.radius = 0.205;
  ring.period = kPeriod;
  RobotModel model = scout();
  model.bumpers = {ring};
  return model;
}

// The obstacle ahead is too low for any range sensor of the Scout.
WorldModel kerb() { return {"kerb", {{"kerb", Box{{1.1, 0, 0}, {0.1, 5}}, 0.2}}, {}}; }

struct Ride {
  explicit Ride(Pose2 start)
      : world(kerb(), {.seed = 1, .realism = Realism::ideal}),
        id(*world.add_robot("dewey", scout_with_bumper(), start)) {}

  // Drives and returns the segments that were pressed meanwhile, as "0 3".
  std::string pressed(double forward, double turn, double seconds) {
    REQUIRE(world.set_velocity_command(id, forward, turn));
    std::vector<bool> felt(8);
    for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) {
      world.step();
      if (const auto& reading = world.bumper(id))
        for (std::size_t k = 0; k < 8; ++k) felt[k] = felt[k] || reading->pressed[k];
    }
    std::string list;
    for (std::size_t k = 0; k < 8; ++k)
      if (felt[k]) list += (list.empty() ? "" : " ") + std::to_string(k);
    return list;
  }

  World world;
  RobotId id;
};

}  // namespace

TEST_CASE("the segment that touches is pressed, and no other", "[sim][bumper]") {
  for (int side = 0; side < 8; ++side) {
    // Turned so that this segment looks at the kerb; ahead for the first, backwards for the fifth ...
    const double yaw = wrapped(-side * 45.0 * kDegree);
    Ride drive({0.7, 0.0, yaw});
    CAPTURE(side);
    const double away = std::cos(yaw);
    if (std::fabs(away) < 0.1) continue;  // A differential base cannot move sideways.
    CHECK(drive.pressed(away > 0.0 ? 0.3 : -0.3, 0.0, 3.0) == std::to_string(side));
  }
}

TEST_CASE("a bumper stays pressed while the robot pushes and is let go when it leaves", "[sim][bumper]") {
  Ride drive({0.5, 0.0, 0.0});
  REQUIRE(drive.pressed(0.3, 0.0, 2.0) == "0");
  REQUIRE(drive.world.set_velocity_command(drive.id, 0.3, 0.0));
  int readings = 0;
  for (int i = 0; i < 100; ++i) {
    drive.world.step();
    if (const auto& reading = drive.world.bumper(drive.id)) {
      ++readings;
      CHECK(reading->pressed[0]);
      CHECK(reading->stamp == drive.world.time());
    }
  }
  CHECK(readings == 10);
  drive.pressed(-0.3, 0.0, 0.5);
  CHECK(drive.pressed(-0.3, 0.0, 0.5).empty());
}

TEST_CASE("a robot that touches nothing presses nothing", "[sim][bumper]") {
  Ride drive({0.0, 0.0, 0.5 * std::numbers::pi});
  CHECK(drive.pressed(0.5, 1.0, 5.0).empty());
}

TEST_CASE("a touch shorter than the period is reported with the next reading", "[sim][bumper]") {
  Ride drive({0.79, 0.0, 0.0});  // 5 mm before the kerb.
  bool touched = false;
  while (!touched) {
    REQUIRE(drive.world.set_velocity_command(drive.id, 0.3, 0.0));
    drive.world.step();
    touched = !drive.world.contacts().empty();
    REQUIRE(drive.world.time() < orca::TimePoint{} + std::chrono::seconds{5});
  }
  CHECK(drive.pressed(-1.0, 0.0, 0.15) == "0");
}
