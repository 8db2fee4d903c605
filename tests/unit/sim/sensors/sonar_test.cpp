// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using orca::direction;
using orca::Pose2;
using orca::Vec2;
using orca::wrapped;
using namespace orca::sim::test;

namespace {

SonarScan first_scan(WorldModel model, Realism realism, Pose2 pose, std::uint64_t seed = 1) {
  World world(std::move(model), {.seed = seed, .realism = realism});
  const RobotId id = *world.add_robot("dewey", scout(), pose);
  while (!world.sonar(id)) world.step();
  return *world.sonar(id);
}

// A wall whose face is met at `distance` from the origin, its normal turned by `angle` from the x axis.
WorldModel wall(double distance, double angle, double length = 20.0) {
  const Vec2 middle = (distance + 0.1) * direction(angle);
  return {"wall", {{"wall", Box{{middle.x, middle.y, angle}, {0.1, 0.5 * length}}, 2.5}}, {}};
}

WorldModel corner() {
  return {"corner",
          {{"east", Box{{2.1, 0, 0}, {0.1, 10}}, 2.5}, {"north", Box{{0, 2.1, 0}, {10, 0.1}}, 2.5}},
          {}};
}

}  // namespace

TEST_CASE("a ring fires its transducers one after the other and is complete at its period", "[sim][sonar]") {
  World world(wall(2.0, 0.0), {.seed = 1, .realism = Realism::nominal});
  const RobotId id = *world.add_robot("dewey", scout(), {});
  for (int tick = 1; tick <= 40; ++tick) {
    world.step();
    REQUIRE(world.sonar(id).has_value() == (tick % 20 == 0));
  }
  const auto& readings = world.sonar(id)->readings;
  REQUIRE(readings.size() == 16);
  for (std::size_t k = 0; k < 16; ++k) {
    CHECK(readings[k].transducer == k);
    CHECK(readings[k].stamp.time_since_epoch() == std::chrono::microseconds{200'000 + 12'500 * (k + 1)});
    CHECK(readings[k].sensor.yaw == Approx(wrapped(static_cast<double>(k) * 22.5 * kDegree)));
    CHECK(norm(readings[k].sensor.position()) == Approx(0.19));
  }
}

TEST_CASE("a wall ahead is heard at its exact distance", "[sim][sonar]") {
  const SonarScan scan = first_scan(wall(2.0, 0.0), Realism::ideal, {});
  CHECK(scan.readings[0].echo);
  CHECK(scan.readings[0].range == Approx(2.0 - 0.19).margin(1e-9));
  CHECK_FALSE(scan.readings[8].echo);
  CHECK(scan.readings[8].range == 6.5);
}

TEST_CASE("a wall whose perpendicular lies in the cone is heard along the perpendicular", "[sim][sonar]") {
  // The foot lies 10 deg off the axis: between two rays of any fan, inside the half lobe of 12.5 deg.
  const SonarScan scan = first_scan(wall(2.0, 10.0 * kDegree), Realism::nominal, {}, 3);
  const double exact = 2.0 - 0.19 * std::cos(10.0 * kDegree);
  CHECK(scan.readings[0].range == Approx(exact).margin(0.06 * exact));
  const SonarScan ideal = first_scan(wall(2.0, 10.0 * kDegree), Realism::ideal, {});
  CHECK(ideal.readings[0].range == Approx(exact).margin(1e-6));
}

TEST_CASE("a smooth wall met at a grazing angle is not heard at nominal realism", "[sim][sonar]") {
  int heard = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    heard += first_scan(wall(1.0, 60.0 * kDegree), Realism::nominal, {}, seed).readings[0].echo ? 1 : 0;
  // Outliers come with a probability of 1 %: two in twenty would be one case in sixty.
  CHECK(heard <= 1);
  CHECK(first_scan(wall(1.0, 60.0 * kDegree), Realism::ideal, {}).readings[0].echo);
}

TEST_CASE("the end of a wall is heard even where its face is not", "[sim][sonar]") {
  // The face is met at 60 deg, but the wall ends on the beam's axis.
  const Vec2 end{2.0, 0.0};
  const double heading = 30.0 * kDegree;
  const Vec2 middle = end + 2.5 * direction(heading) + 0.05 * direction(heading + 0.5 * std::numbers::pi);
  const WorldModel model{"end", {{"wall", Box{{middle.x, middle.y, heading}, {2.5, 0.05}}, 2.5}}, {}};
  int heard = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SonarReading r = first_scan(model, Realism::nominal, {}, seed).readings[0];
    heard += r.echo && std::fabs(r.range - 1.81) < 0.1 ? 1 : 0;
  }
  CHECK(heard >= 18);
}

TEST_CASE("a corner is heard at its own distance even if its walls are not heard", "[sim][sonar]") {
  // Transducer 2 looks at 45 deg, straight into the corner at (2, 2): both walls are met at 45 deg.
  const double exact = std::sqrt(8.0) - 0.19;
  int heard = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SonarReading r = first_scan(corner(), Realism::nominal, {}, seed).readings[2];
    heard += r.echo && std::fabs(r.range - exact) < 0.05 * exact ? 1 : 0;
  }
  CHECK(heard >= 18);
}

TEST_CASE("a post is heard at its nearest point, also off the axis", "[sim][sonar]") {
  const Vec2 at = 2.0 * direction(5.0 * kDegree);
  const WorldModel post{"post", {{"post", Circle{at, 0.05}, 2.5}}, {}};
  const SonarReading r = first_scan(post, Realism::ideal, {}).readings[0];
  CHECK(r.range == Approx(norm(at - Vec2{0.19, 0.0}) - 0.05).margin(1e-9));
  CHECK_FALSE(first_scan(post, Realism::ideal, {}).readings[2].echo);
}

TEST_CASE("echoes nearer than the minimum range read as the minimum range", "[sim][sonar]") {
  CHECK(first_scan(wall(0.25, 0.0), Realism::ideal, {}).readings[0].range == 0.15);
}

TEST_CASE("readings at nominal realism scatter by one percent and come in whole steps", "[sim][sonar]") {
  double sum = 0.0;
  int good = 0;
  constexpr int kRuns = 200;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const double range = first_scan(wall(4.19, 0.0), Realism::nominal, {}, seed).readings[0].range;
    const double steps = range / 0.0254;
    CHECK((range == 6.5 || std::fabs(steps - std::round(steps)) < 1e-9));
    if (std::fabs(range - 4.0) > 0.2) continue;  // Five deviations: an outlier.
    ++good;
    sum += range;
  }
  CHECK(good >= kRuns * 95 / 100);
  // Five standard errors of the mean: 5 * 0.04 / sqrt(190) = 0.015.
  CHECK(sum / good == Approx(4.0).margin(0.015));
}

TEST_CASE("another robot is heard, the sonar's own robot is not", "[sim][sonar]") {
  World world(WorldModel{}, {.seed = 1, .realism = Realism::ideal});
  const RobotId a = *world.add_robot("a", scout(), {});
  REQUIRE(world.add_robot("b", scout(), {2, 0, 0}));
  for (int i = 0; i < 20; ++i) world.step();
  CHECK(world.sonar(a)->readings[0].range == Approx(2.0 - 0.19 - 0.205).margin(1e-9));
  CHECK_FALSE(world.sonar(a)->readings[8].echo);
}

TEST_CASE("the footprint of a round robot is a circle and that of a box robot its hull", "[sim][robot]") {
  CHECK(std::get<Circle>(scout().footprint).radius == 0.205);
  const std::vector<Part> parts{{Part::Block{0.5, 0.4, 0.2}, {.z = 0.1}},
                                {Part::Ball{0.05}, {.x = 0.3, .z = 0.05}}};
  const Shape hull = footprint_of(parts);
  CHECK(contains(hull, {0.24, 0.19}));
  CHECK(contains(hull, {0.349, 0.0}));
  CHECK_FALSE(contains(hull, {0.26, 0.19}));
  CHECK_FALSE(contains(hull, {0.356, 0.0}));
  CHECK(height_range_of(parts).first == Approx(0.0).margin(1e-12));
  CHECK(height_range_of(parts).second == Approx(0.2));
}
