// SPDX-License-Identifier: GPL-3.0-or-later
// What sensors see of a robot: its section at their own height, and not the plan of all heights.
#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/base/random.hpp"
#include "orca/sim/sections.hpp"
#include "orca/sim/world.hpp"
#include "scout.hpp"

using namespace orca::sim;
using orca::direction;
using orca::Pose2;
using orca::RandomStream;
using orca::Vec2;
using orca::sim::test::kDegree;
using orca::sim::test::kPi;

namespace {

constexpr double kEye = 0.8;  // [m]

RobotModel robot_of(std::vector<Part> parts) {
  RobotModel m = sim::test::scout();
  m.parts = std::move(parts);
  m.footprint = footprint_of(m.parts);
  std::tie(m.bottom, m.top) = height_range_of(m.parts);
  m.sonars.clear();
  return m;
}

// A base of 0.6 m with a mast of 6 cm that stands 0.2 m before its middle.
RobotModel masted() {
  return robot_of(
      {{Part::Cylinder{0.3, 0.3}, {.z = 0.15}}, {Part::Cylinder{0.03, 0.9}, {.x = 0.2, .z = 0.75}}});
}

LaserScanner laser_at(double height) {
  LaserScanner laser;
  laser.name = "laser";
  laser.count = 181;
  laser.first_angle = -0.5 * kPi;
  laser.pitch = kDegree;
  laser.max_range = 8.0;
  laser.period = std::chrono::milliseconds{100};
  laser.height = height;
  return laser;
}

// Returns the ranges that an ideal laser at the origin measures, one per degree from the right to the left.
std::vector<double> scan(World& world, double height) {
  RobotModel watcher = robot_of({{Part::Cylinder{0.1, 1.0}, {.z = 0.5}}});
  watcher.lasers = {laser_at(height)};
  const RobotId id = *world.add_robot("watcher", watcher, {});
  for (int tick = 0; tick < 100; ++tick) {
    world.step();
    if (const auto& scan = world.laser(id)) return scan->ranges;
  }
  FAIL("the laser gave no scan");
  return {};
}

std::size_t count_near(const std::vector<double>& ranges) {
  return static_cast<std::size_t>(std::ranges::count_if(ranges, [](double range) { return range < 7.9; }));
}

Part random_part(RandomStream& random) {
  const auto size = [&] { return random.uniform(0.05, 0.4); };
  Part part;
  const double kind = random.uniform(0.0, 4.0);
  part.form = Part::Ball{size()};
  if (kind < 1.0) part.form = Part::Block{size(), size(), size()};
  if (kind >= 1.0 && kind < 2.0) part.form = Part::Cylinder{0.5 * size(), size()};
  if (kind >= 2.0 && kind < 3.0) {
    Part::Hull hull;
    for (int i = 0; i < 8; ++i) hull.corners.push_back({size() - 0.2, size() - 0.2, size() - 0.2});
    part.form = hull;
  }
  part.X_BP = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(0.1, 0.9)};
  if (random.chance(0.6)) {  // Tilted, else upright.
    const Vec2 half = direction(random.uniform(0.0, kPi));
    const Vec2 axis = direction(random.uniform(0.0, 2.0 * kPi));
    part.X_BP.qw = half.x;
    part.X_BP.qx = half.y * axis.x;
    part.X_BP.qy = half.y * axis.y;
  }
  return part;
}

// Returns the range to the sections of a robot at the height of a ray, each in a world of its own.
double range_to_section(const RobotModel& robot, const Pose2& X_WB, const Ray& ray) {
  WorldModel world{"section", {}, {}};
  for (const Shape& section : robot.section_at(ray.sensor_height))
    world.obstacles.push_back({"section", placed(section, X_WB), 100.0});
  return Caster(world).cast(ray).range;
}

}  // namespace

TEST_CASE("a laser sees a robot's mast as a mast at the mast's height, and the base below it",
          "[sim][sight]") {
  const auto see = [](double height) {
    World world({"empty", {}, {}}, {.seed = 1, .realism = Realism::ideal});
    REQUIRE(world.add_robot("seen", masted(), {2.0, 0.0, 0.0}));
    return scan(world, height);
  };
  const std::vector<double> at_mast = see(kEye);
  CHECK(at_mast[90] == Approx(2.2 - 0.03).margin(1e-6));
  CHECK(count_near(at_mast) == 1);  // 2 asin(0.03 / 2.2) = 1.6 degrees, symmetric about the beam ahead.
  const std::vector<double> at_base = see(0.2);
  CHECK(at_base[90] == Approx(2.0 - 0.3).margin(1e-6));
  CHECK(count_near(at_base) == 17);  // asin(0.3 / 2) = 8.6 degrees to both sides.
  CHECK(count_near(see(1.3)) == 0);
}

TEST_CASE("a sonar hears a robot's mast, and the base only if its cone reaches down to it", "[sim][sight]") {
  const auto hear = [](double distance) {
    World world({"empty", {}, {}}, {.seed = 1, .realism = Realism::ideal});
    RobotModel watcher = robot_of({{Part::Cylinder{0.1, 1.0}, {.z = 0.5}}});
    SonarRing ring = sim::test::scout().sonars.at(0);
    ring.height = kEye;
    ring.radius = 0.1;
    ring.quantum = 0.0;
    watcher.sonars = {ring};
    const RobotId id = *world.add_robot("watcher", watcher, {});
    REQUIRE(world.add_robot("seen", masted(), {distance, 0.0, 0.0}));
    for (int tick = 0; tick < 100; ++tick) {
      world.step();
      if (const auto& scan = world.sonar(id))
        for (const SonarReading& reading : scan->readings)
          if (reading.transducer == 0) return reading.range;
    }
    return -1.0;
  };
  // At 1.5 m the cone reaches 0.3 m down to 0.5 m, at 4 m to below the floor: the slanted way to the base's rim.
  CHECK(hear(1.5) == Approx(1.7 - 0.03 - 0.1).margin(1e-6));
  const double to_base = 4.0 - 0.3 - 0.1;
  CHECK(hear(4.0) == Approx(std::sqrt(to_base * to_base + 0.5 * 0.5)).margin(1e-6));
}

TEST_CASE("rays at the heights of sensors meet the exact section of any part, upright or not",
          "[sim][sight]") {
  RandomStream random(51, "test", "parts");
  int met = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Part> parts;
    for (int i = 0; i < 4; ++i) parts.push_back(random_part(random));
    RobotModel seen = robot_of(parts);
    seen.lasers = {laser_at(random.uniform(0.1, 1.0))};
    RobotModel other = robot_of({{Part::Cylinder{0.1, 1.0}, {.z = 0.5}}});
    other.lasers = {laser_at(random.uniform(0.1, 1.0)), laser_at(random.uniform(0.1, 1.0))};
    const Pose2 X_WB{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-kPi, kPi)};
    World world({"empty", {}, {}}, {.seed = 1, .realism = Realism::ideal});
    const RobotId id = *world.add_robot("seen", seen, X_WB);
    REQUIRE(world.add_robot("other", other, {50.0, 0.0, 0.0}));
    for (const double height : {seen.lasers[0].height, other.lasers[0].height, other.lasers[1].height})
      for (int i = 0; i < 40; ++i) {
        const Vec2 from = X_WB.position() + 2.0 * direction(random.uniform(-kPi, kPi));
        const Vec2 to = X_WB.position() + random.uniform(0.0, 0.4) * direction(random.uniform(-kPi, kPi));
        const Ray ray{from, (1.0 / norm(to - from)) * (to - from), 8.0, height};
        CAPTURE(round, i, height);
        const Hit hit = world.caster().cast(ray);
        REQUIRE(hit.range == range_to_section(seen, world.body_pose(id), ray));
        met += hit.found() ? 1 : 0;
      }
  }
  CHECK(met > 1000);
}
