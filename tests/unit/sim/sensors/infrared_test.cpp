// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"
#include "statistics.hpp"

using namespace orca::sim;
using orca::direction;
using orca::Vec2;
using namespace orca::sim::test;

namespace {

InfraredRing ring() {
  InfraredRing ring;
  ring.name = "infrared";
  ring.count = 8;
  ring.pitch = 45.0 * kDegree;
  ring.half_beam = 3.0 * kDegree;
  ring.max_range = 0.8;
  ring.radius = 0.19;
  ring.period = std::chrono::milliseconds{50};
  ring.height = 0.3;
  return ring;
}

RobotModel scout_with_infrared() {
  RobotModel model = scout();
  model.infrareds = {ring()};
  return model;
}

WorldModel world_with_wall(double distance) {
  return {"wall", {{"wall", Box{{distance + 0.1, 0, 0}, {0.1, 5}}, 2.5}}, {}};
}

// Returns that many readings of the sensor that looks ahead, at a wall `range` from it.
std::vector<double> readings(double range, int n, Realism realism) {
  World world(world_with_wall(0.19 + range), {.seed = 4, .realism = realism});
  const RobotId id = *world.add_robot("dewey", scout_with_infrared(), {});
  std::vector<double> seen;
  while (static_cast<int>(seen.size()) < n) {
    world.step();
    if (world.infrared(id)) seen.push_back(world.infrared(id)->ranges[0]);
  }
  return seen;
}

}  // namespace

TEST_CASE("an infrared ring measures all around at once, at its period", "[sim][infrared]") {
  World world(world_with_wall(0.59), {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", scout_with_infrared(), {});
  for (int tick = 1; tick <= 20; ++tick) {
    world.step();
    REQUIRE(world.infrared(id).has_value() == (tick % 5 == 0));
  }
  CHECK(world.infrared(id)->stamp == world.time());
  CHECK(world.infrared(id)->ranges[0] == Approx(0.4).margin(1e-9));
  CHECK(world.infrared(id)->ranges[4] == 0.8);
}

TEST_CASE("the nearest obstacle in an infrared beam counts, even at the beam's rim", "[sim][infrared]") {
  // A pin on the rim of the beam, before a wall.
  WorldModel model = world_with_wall(0.79);
  const Vec2 at = Vec2{0.19, 0.0} + 0.3 * direction(3.0 * kDegree);
  model.obstacles.push_back({"pin", Circle{at, 0.005}, 2.5});
  World world(std::move(model), {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", scout_with_infrared(), {});
  while (!world.infrared(id)) world.step();
  CHECK(world.infrared(id)->ranges[0] == Approx(0.295).margin(1e-9));
}

TEST_CASE("the deviation of an infrared range grows with the square of the range", "[sim][infrared]") {
  constexpr int kReadings = 2000;
  for (const double range : {0.2, 0.4, 0.7}) {
    const std::vector<double> seen = readings(range, kReadings, Realism::nominal);
    const double sigma = 0.05 * range * range;
    CAPTURE(range);
    CHECK(distance_from(seen, [&](double r) { return normal_cdf((r - range) / sigma); }) <
          critical_distance(kReadings));
  }
}
