// SPDX-License-Identifier: GPL-3.0-or-later
// Sills and wet patches: what a floor does to the true motion, and no encoder sees.
#include <catch2/catch.hpp>

#include "bases.hpp"
#include "orca/sim/world_file.hpp"
#include "orca/xml/diagnostics.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using orca::Pose2;

namespace {

// A Scout that drives 2 m ahead at 0.2 m/s on some floor, and what its odometry believes.
struct Drive2m {
  explicit Drive2m(Floor floor, Realism realism = Realism::ideal, std::uint64_t seed = 1) {
    WorldModel model;
    model.floor = std::move(floor);
    World world(model, {.seed = seed, .realism = realism});
    const RobotId id = *world.add_robot("dewey", base_of(DriveKind::differential), {});
    REQUIRE(world.set_velocity_command(id, {.forward = 0.2}));
    while (believed.x < 2.0) {
      world.step();
      believed = world.odometry(id).value().pose;
    }
    real = world.pose(id);
  }
  Pose2 believed;
  Pose2 real;
};

constexpr double kScoutWheel = 0.15;  // [m] of the test's Scout
constexpr double kScoutTrack = 0.3452;

// The way lost on an edge, by adding up small steps of the hub on its two arcs.
double summed_loss(double diameter, double height) {
  const double r = 0.5 * diameter;
  const double begin = -std::sqrt(r * r - (r - height) * (r - height));
  double arc = 0.0;
  constexpr int kSteps = 1'000'000;
  for (int i = 0; i < kSteps; ++i) {
    const double x = begin * (1.0 - 2.0 * (i + 0.5) / kSteps);
    arc += -2.0 * begin / kSteps * r / std::sqrt(r * r - x * x);  // the length of the circle over dx
  }
  return arc - 2.0 * -begin;
}

}  // namespace

TEST_CASE("a sill across the way costs both wheels what they climb, and the odometry believes more",
          "[sim][floor]") {
  const Drive2m drive({.patches = {}, .sills = {{"sill", {{1.0, -1.0}, {1.0, 1.0}}, 0.005}}});
  CHECK(drive.believed.x - drive.real.x == Approx(summed_loss(kScoutWheel, 0.005)).margin(1e-7));
  CHECK(drive.real.yaw == Approx(0.0).margin(1e-12));
}

TEST_CASE("a sill under one wheel turns the base, and the odometry believes it went straight",
          "[sim][floor]") {
  const Drive2m drive(
      {.patches = {}, .sills = {{"sill", {{1.0, 0.05}, {1.0, 1.0}}, 0.005}}});  // under the left one
  CHECK(drive.real.yaw == Approx(summed_loss(kScoutWheel, 0.005) / kScoutTrack).margin(1e-6));
  CHECK(drive.believed.yaw == Approx(0.0).margin(1e-9));
}

TEST_CASE("on a wet patch slip scatters the base by the patch's factor more", "[sim][floor]") {
  const auto deviation = [](const Floor& floor) {
    double squares = 0.0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const Drive2m drive(floor, Realism::nominal, seed);
      squares += drive.real.yaw * drive.real.yaw / 200.0;
    }
    return std::sqrt(squares);
  };
  const Floor wet{.patches = {{"puddle", outline_of({{-1, -9}, {9, -9}, {9, 9}, {-1, 9}}), 10.0, 0.5}},
                  .sills = {}};
  // Slip alone turns the base by 3 mm root(2 x 2 m) over the track; unequal wheels add as much to both.
  const double of_slip = 0.003 * std::sqrt(2.0 * 2.0) / kScoutTrack;
  const double dry = deviation({});
  CHECK(std::sqrt(std::pow(deviation(wet), 2) - dry * dry) ==
        Approx(of_slip * std::sqrt(99.0)).epsilon(0.2));  // 200 seeds, four sigma
}

TEST_CASE("a world file may have sills and wet patches; what makes no sense is refused at its place",
          "[sim][floor]") {
  orca::xml::Diagnostics errors;
  const auto world = read_world_text(
      "<world name='w' version='1'><sill name='door' from='0 0' to='1 0' height='5 mm'/>"
      "<wet points='0 0; 1 0; 1 1' slip='3' grip='0.4'/></world>",
      "w.xml", errors);
  INFO(errors.text());
  REQUIRE(world);
  REQUIRE(world->floor.sills.size() == 1);
  CHECK(world->floor.sills[0].height == Approx(0.005));
  CHECK(world->floor.slip_at({0.9, 0.1}) == 3.0);
  CHECK(world->floor.grip_at({0.9, 0.1}) == 0.4);
  CHECK(world->floor.slip_at({0.1, 0.9}) == 1.0);
  orca::xml::Diagnostics faults;
  CHECK_FALSE(
      read_world_text("<world name='w' version='1'><sill from='0 0' to='1 0' height='1 m'/>"
                      "<wet points='0 0; 1 0' slip='0.5'/></world>",
                      "w.xml", faults));
  CHECK(faults.error_count() == 3);
}

TEST_CASE("a command that is no speed of any robot is refused by name", "[sim][drive]") {
  World world({}, {});
  const RobotId id = *world.add_robot("dewey", scout(), {});
  for (const double speed : {1e300, -1e4, std::nan("")}) {
    const orca::Status refused = world.set_velocity_command(id, speed, 0.0);
    REQUIRE_FALSE(refused.ok());
    CHECK_THAT(refused.error().text(), Catch::Contains("dewey"));
  }
}

TEST_CASE(
    "the shipped court leads a robot that trusts its wheels farther off than a court with a dry, even floor",
    "[sim][floor]") {
  orca::xml::Diagnostics errors;
  auto court = read_world(ORCA_SOURCE_DIR "/sim/worlds/court.xml", {}, errors);
  INFO(errors.text());
  REQUIRE(court);
  const auto off_after_north_side = [](const WorldModel& model) {
    double squares = 0.0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      World world(model, {.seed = seed, .realism = Realism::nominal});
      const Pose2 start{6.5, 2.5, 0.5 * std::numbers::pi};  // over the sill, then west along the north side
      const RobotId id = *world.add_robot("dewey", base_of(DriveKind::differential), start);
      for (int tick = 0; tick < 2000; ++tick) {
        const double turn = tick >= 500 && tick < 814 ? 0.5 : 0.0;
        REQUIRE(world.set_velocity_command(id, {.forward = turn > 0.0 ? 0.0 : 0.4, .turn_rate = turn}));
        world.step();
      }
      const Pose2 believed = start * world.odometry(id).value().pose;
      squares += dot(believed.position() - world.pose(id).position(),
                     believed.position() - world.pose(id).position()) /
                 100.0;
    }
    return std::sqrt(squares);
  };
  const double with_floor = off_after_north_side(*court);
  court->floor = {};
  const double without = off_after_north_side(*court);
  INFO("off by " << with_floor << " m, and " << without << " m on a dry, even floor");
  CHECK(with_floor > 1.1 * without);
}
