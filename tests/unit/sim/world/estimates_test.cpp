// SPDX-License-Identifier: GPL-3.0-or-later
// Each estimate that every level shares changes what depends on it, in the direction that it should.
#include <catch2/catch.hpp>

#include "laser.hpp"
#include "orca/sim/realism.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using orca::direction;
using orca::Vec2;

namespace {

World estimated_world(const WorldModel& model, const ErrorLevels& errors, const std::string& factors) {
  return World(model, {.seed = 1, .errors = scaled(errors, factors).value()});
}

// Where the transducer that looks ahead is.
constexpr Vec2 kFrontSonar{0.19, 0.0};

// Returns what the transducer ahead of a Scout reads that stands at the origin.
SonarReading heard_ahead(const WorldModel& model, const std::string& factors) {
  World world = estimated_world(model, {.critical_angle = 25.0 * kDegree}, factors);
  const RobotId scout = world.add_robot("dewey", orca::sim::test::scout(), {}).value();
  do world.step();
  while (!world.sonar(scout));
  return world.sonar(scout)->readings.at(0);
}

// A wedge that turns its point to the sonar, 2 m away. Its faces mirror the sound away.
WorldModel wedge(double bearing) {
  const Vec2 point = kFrontSonar + 2.0 * direction(bearing);
  return {"wedge",
          {{"wedge",
            outline_of({point, point + 1.5 * direction(bearing + 20.0 * kDegree),
                        point + 1.5 * direction(bearing + 50.0 * kDegree)}),
            2.5}},
          {}};
}

// Two smooth walls that meet 2 m ahead at a small angle, both at about 50 deg to the beam.
WorldModel bent_wall(double bend) {
  const Vec2 middle = kFrontSonar + Vec2{2.0, 0.0};
  const Vec2 one = direction(40.0 * kDegree);
  const Vec2 other = direction(40.0 * kDegree + bend);
  const Vec2 behind = 0.5 * direction(-50.0 * kDegree);
  return {"bent",
          {{"wall", outline_of({middle - 3.0 * other, middle + behind, middle + 3.0 * one, middle}), 2.5}},
          {}};
}

// Returns the reading of the laser's beam ahead. Half of its spot is 0.125 deg wide. What is near, at 2 m, ends 0.1 deg
// beside it; what is far stands at 3 m.
double read_beside_edge(const std::string& factors) {
  constexpr double kThin = 1e-4;
  const double end = 2.0 * std::tan(0.1 * kDegree);
  const WorldModel edge{"edge",
                        {{"near", Box{{2.0 + 0.5 * kThin, end - 2.0, 0}, {0.5 * kThin, 2.0}}, 2.5},
                         {"far", Box{{3.1, 0, 0}, {0.1, 20}}, 2.5}},
                        {}};
  World world = estimated_world(edge, {.mixed_pixels = true}, factors);
  return next_scan(world, world.add_robot("dewey", scout_with(lms200()), {}).value()).ranges.at(90);
}

// Returns how fast a Scout is that has driven along a wall for 5 s and wants 0.4 m/s, turned to the wall by an angle.
double speed_along_wall(double angle, const std::string& factors) {
  World world = estimated_world(test_room(), {}, factors);
  const RobotId scout =
      world.add_robot("dewey", orca::sim::test::scout(), {-4.0, 5.0 - 0.206, angle}).value();
  REQUIRE(world.set_velocity_command(scout, {.forward = 0.4}));
  for (int i = 0; i < 500; ++i) world.step();
  return world.velocity(scout).forward;
}

// Returns the largest angle [deg] at which the Scout still slides along a wall, to 0.1 deg; 0 if it is held at 0.1 deg.
double steepest_slide(const std::string& factors) {
  int tenths = 1;
  while (tenths < 600 && speed_along_wall(0.1 * tenths * kDegree, factors) > 0.2) ++tenths;
  return 0.1 * (tenths - 1);
}

// Returns how far a Scout is pushed by one of twice its mass that drives into its back for 3 s.
double pushed_by_heavier(const std::string& factors) {
  World world = estimated_world({}, {}, factors);
  RobotModel heavy = orca::sim::test::scout();
  heavy.mass *= 2.0;
  const RobotId light = world.add_robot("light", orca::sim::test::scout(), {0.5, 0.0, 0.0}).value();
  const RobotId pusher = world.add_robot("heavy", heavy, {}).value();
  REQUIRE(world.set_velocity_command(pusher, {.forward = 0.4}));
  for (int i = 0; i < 300; ++i) world.step();
  return world.pose(light).x - 0.5;
}

}  // namespace

TEST_CASE("sonar_edges and sonar_threshold bound the part of the beam in which edges are heard",
          "[sim][errors]") {
  const WorldModel inside = wedge(8.0 * kDegree);  // Edges are heard up to 9.3 deg.
  const WorldModel outside = wedge(11.0 * kDegree);
  REQUIRE(heard_ahead(inside, "").range == Approx(2.0).margin(1e-6));
  REQUIRE_FALSE(heard_ahead(outside, "").echo);
  for (const char* less : {"sonar_edges=0.5", "sonar_edges=0", "sonar_threshold=2"})
    CHECK_FALSE(heard_ahead(inside, less).echo);
  for (const char* more : {"sonar_edges=2", "sonar_threshold=0.5", "sonar_threshold=0"})
    CHECK(heard_ahead(outside, more).range == Approx(2.0).margin(1e-6));
}

TEST_CASE("sonar_in_line bounds the bends of a wall that are no edges", "[sim][errors]") {
  REQUIRE_FALSE(heard_ahead(bent_wall(0.75 * kDegree), "").echo);
  REQUIRE(heard_ahead(bent_wall(1.5 * kDegree), "").echo);
  CHECK(heard_ahead(bent_wall(0.75 * kDegree), "sonar_in_line=0.5").range == Approx(2.0).margin(1e-6));
  CHECK_FALSE(heard_ahead(bent_wall(1.5 * kDegree), "sonar_in_line=2").echo);
}

TEST_CASE("laser_spot bounds how near a beam has to come to an edge to read a mixture", "[sim][errors]") {
  CHECK(read_beside_edge("") == Approx(2.1).margin(1e-3));  // A tenth of the spot lies on what is far.
  CHECK(read_beside_edge("laser_spot=2") == Approx(2.3).margin(1e-3));
  CHECK(read_beside_edge("laser_spot=0.5") == Approx(2.0).margin(1e-3));
  CHECK(read_beside_edge("laser_spot=0") == Approx(2.0).margin(1e-3));
}

// A base slides along a wall as long as its motors overcome the friction of the wall and of the wheels that are pushed
// aside: tan(angle) < F/S - 0.16 with motors of F = 2 x 0.76 m/s2 per mass and wheels that hold S = 0.7 x 9.81 m/s2. That is 3.5 deg.
TEST_CASE("contact_friction, wheel_grip and motor_force say up to which angle a base slides along a wall",
          "[sim][errors]") {
  CHECK(steepest_slide("") == Approx(3.5).margin(0.3));
  for (const char* easier : {"contact_friction=0.5", "wheel_grip=0.5", "motor_force=2"}) {
    CAPTURE(easier, steepest_slide(easier));
    CHECK(steepest_slide(easier) > 5.0);
  }
  for (const char* harder : {"contact_friction=2", "wheel_grip=2", "motor_force=0.5"}) {
    CAPTURE(harder, steepest_slide(harder));
    CHECK(steepest_slide(harder) == 0.0);
  }
}

TEST_CASE("wheel_grip and motor_force say whether a heavier base pushes one that stands", "[sim][errors]") {
  CHECK(pushed_by_heavier("") < 0.05);  // what the impact does
  CHECK(pushed_by_heavier("wheel_grip=0.3") > 0.1);
  CHECK(pushed_by_heavier("motor_force=3") > 0.1);
}
