// SPDX-License-Identifier: GPL-3.0-or-later
#include "own_sight.hpp"

#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/sim/world.hpp"
#include "shipped.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using Catch::Contains;

TEST_CASE("each shipped robot is solid at the height of each sensor of its own", "[sim][robots]") {
  const std::string name =
      GENERATE("barn_base", "courier", "create2", "nomad_200", "nomad_scout", "nomad_xr4000", "omni",
               "peoplebot", "pioneer_2dx", "pioneer_2dx_camera", "pioneer_2dx_gripper");
  INFO(name);
  CHECK(gaps_at_own_sensors(shipped(name)).empty());
}

TEST_CASE("a gap names the sensor, its height and the robot", "[sim][robots]") {
  RobotModel robot = shipped("pioneer_2dx");
  robot.lasers.at(0).height = 0.5;
  const auto gaps = gaps_at_own_sensors(robot);
  REQUIRE(gaps.size() == 1);
  CHECK_THAT(gaps[0], Contains("the laser \"laser\" is 0.5 m above the floor"));
  CHECK_THAT(gaps[0], Contains("\"pioneer_2dx\" has nothing solid"));
}

TEST_CASE("a ring with transducers at two heights is judged at both", "[sim][robots]") {
  RobotModel robot = shipped("peoplebot");
  for (Part& part : robot.parts) part.X_BP.z += 0.2;  // All parts begin above the lower transducers.
  robot.lasers.clear();
  const auto gaps = gaps_at_own_sensors(robot);
  REQUIRE(gaps.size() == 1);
  CHECK_THAT(gaps[0], Contains("sonar ring \"sonar\" is 0.17 m"));
  for (Part& part : robot.parts) part.X_BP.z += 5.0;
  CHECK(gaps_at_own_sensors(robot).size() == 2);
}

TEST_CASE("infrared rings are judged too", "[sim][robots]") {
  RobotModel robot = shipped("nomad_200");
  REQUIRE_FALSE(robot.infrareds.empty());
  robot.infrareds[0].height = 3.0;
  REQUIRE(gaps_at_own_sensors(robot).size() == 1);
  CHECK_THAT(gaps_at_own_sensors(robot)[0], Contains("infrared ring"));
}

TEST_CASE("where a gap is reported, a laser does not see the robot, and else it does", "[sim][robots]") {
  RobotModel robot = shipped(GENERATE("barn_base", "courier", "create2", "nomad_200", "nomad_scout",
                                      "nomad_xr4000", "omni", "peoplebot", "pioneer_2dx"));
  const LaserScanner laser = shipped("pioneer_2dx").lasers.at(0);
  robot.sonars.clear();
  robot.infrareds.clear();
  int seen = 0, unseen = 0;
  for (double height = 0.015; height < 1.4; height += 0.02) {
    robot.lasers = {laser};
    robot.lasers[0].height = height;
    World world({"empty", {}, {}}, {.seed = 1, .realism = Realism::ideal});
    REQUIRE(world.add_robot("seen", robot, {2.0, 0.0, 0.7}));
    bool is_met = false;
    for (double angle = -0.3; angle < 0.3; angle += 0.005)
      is_met = is_met || world.caster().cast({{0, 0}, orca::direction(angle), 8.0, height}).found();
    CAPTURE(robot.name, height);
    REQUIRE(is_met == gaps_at_own_sensors(robot).empty());
    (is_met ? seen : unseen)++;
  }
  CHECK(seen > 5);
  CHECK(unseen > 5);
}
