// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <fstream>
#include <numbers>

#include "all_objects.hpp"
#include "reading.hpp"

using namespace orca;
using orca::test::read;
using orca::test::reading;
using orca::test::written;

TEST_CASE("a person can type a goal", "[text][xml]") {
  const auto goal = read<idl::GoalPoint>(
      R"x(<GoalPoint name="kitchen"><coordinate x="3.6" y="6"/><reach_radius distance="0.3 m"/></GoalPoint>)x");
  idl::GoalPoint expected;
  expected.name("kitchen");
  expected.reach_radius().distance(0.3);
  expected.coordinate().point().x(3.6);
  expected.coordinate().point().y(6.0);
  CHECK(goal == expected);
}

TEST_CASE("an object is written on one line, plain values as attributes", "[text][xml]") {
  idl::MotionCommand command;
  command.creation_time().ns(12'050'000'000);
  command.origin("goto");
  command.origin_port("motion");
  command.seq(17);
  command.mission(3);
  command.kind(idl::FULLSTOP);
  command.steering(idl::BY_TURN_RATE);
  command.turn_rate(-0.25);
  command.speed(1e-7);
  command.weight(2.0);
  CHECK(
      written(command) ==
      R"x(<MotionCommand creation_time="12.05" origin="goto" origin_port="motion" seq="17" mission="3" )x"
      R"x(kind="FULLSTOP" steering="BY_TURN_RATE" direction="0" turn_rate="-0.25" speed="1e-07" weight="2"/>)x");
}

TEST_CASE("structs are written as elements; one without content is left out", "[text][xml]") {
  idl::GoalPoint goal;
  goal.cause().origin("command");
  goal.cause().port("goto");
  goal.cause().seq(4);
  goal.coordinate().uncertainty().y(0.1);
  const std::string text = written(goal);
  CHECK_THAT(text, Catch::Contains(R"x(<cause origin="command" port="goto" seq="4"/>)x"));
  CHECK_THAT(text, Catch::Contains(
                       R"x(<coordinate x="0" y="0" z="0"><uncertainty x="0" y="0.1" z="0"/></coordinate>)x"));
  CHECK_THAT(written(idl::GoalPoint()), !Catch::Contains("<cause") && !Catch::Contains("<coordinate"));
}

TEST_CASE("the first struct in a struct has no element of its own, at any depth", "[text][xml]") {
  idl::LaserSensor laser;
  laser.mount().position().x(0.2);
  laser.mount().rotation().yaw(0.5);
  CHECK_THAT(written(laser),
             Catch::EndsWith(R"x(<mount x="0.2" y="0" z="0">)x"
                             R"x(<rotation roll="0" pitch="0" yaw="0.5"/></mount></LaserSensor>)x"));
}

TEST_CASE("a struct that travels is written as it is within others, with the header's attributes first",
          "[text][xml]") {
  Travelling<idl::WorldCoordinate3D> place;
  place.seq(4);
  place.cause().seq(2);
  place.point().x(3.6);
  place.uncertainty().y(0.1);
  CHECK(
      written(place) ==
      R"x(<WorldCoordinate3D creation_time="0" origin="" origin_port="" seq="4" mission="0" x="3.6" y="0" z="0">)x"
      R"x(<cause origin="" port="" seq="2"/><uncertainty x="0" y="0.1" z="0"/></WorldCoordinate3D>)x");
  CHECK(read<Travelling<idl::WorldCoordinate3D>>(R"x(<WorldCoordinate3D x="3.6"/>)x").point().x() == 3.6);
  CHECK(read<Travelling<idl::Pose2D>>(R"x(<Pose2D x="1" orientation="90 deg"/>)x").orientation() ==
        std::numbers::pi / 2);
}

TEST_CASE("a list of numbers is one attribute, and a list of structs has one element for each",
          "[text][xml]") {
  idl::SonarRangeReadings sonar;
  sonar.ranges({1.5, 0.25});
  sonar.stamps().resize(2);
  sonar.stamps()[0].ns(-1'500'000'000);
  sonar.poses().resize(2);
  sonar.poses()[1].rotation().yaw(0.5);
  const std::string text = written(sonar);
  CHECK_THAT(text, Catch::Contains(R"x( ranges="1.5 0.25")x"));
  CHECK_THAT(text, Catch::Contains(R"x( stamps="-1.5 0")x"));
  CHECK_THAT(text, Catch::Contains(
                       R"x(<poses x="0" y="0" z="0"/>)x"
                       R"x(<poses x="0" y="0" z="0"><rotation roll="0" pitch="0" yaw="0.5"/></poses>)x"));
  CHECK_THAT(text, !Catch::Contains("ranges_uncertainty"));  // Empty.
}

TEST_CASE("a list of texts has one element for each, because texts may hold blanks", "[text][xml]") {
  idl::ClientList list;
  list.clients({"goto", "a b", ""});
  CHECK_THAT(written(list),
             Catch::EndsWith(R"x(><clients value="goto"/><clients value="a b"/><clients value=""/>)x"
                             "</ClientList>"));
  CHECK(read<idl::ClientList>(R"x(<ClientList><clients value="goto"/></ClientList>)x").clients() ==
        std::vector<std::string>{"goto"});
}

TEST_CASE("a covariance is left out while it is not known", "[text][xml]") {
  idl::RobotPose pose;
  CHECK_THAT(written(pose), !Catch::Contains("covariance"));
  pose.covariance()[8] = 0.01;
  CHECK_THAT(written(pose), Catch::Contains(R"x( covariance="0 0 0 0 0 0 0 0 0.01")x"));
}

TEST_CASE("the header of an object within an object is written only if it was stamped", "[text][xml]") {
  idl::Robot robot;
  robot.drives().resize(1);
  CHECK_THAT(written(robot), Catch::Contains(R"x(<drives name="" vendor)x"));
  robot.drives()[0].seq(9);
  CHECK_THAT(written(robot), Catch::Contains(R"x(<drives seq="9" name="" vendor)x"));
}

TEST_CASE("a field that is not mentioned keeps its default, and the header may be missing", "[text][xml]") {
  CHECK(read<idl::Odometry>("<Odometry/>") == idl::Odometry());
  idl::Odometry moving;
  moving.x(1.0);
  moving.seq(3);
  CHECK(read<idl::Odometry>(R"x(<Odometry x="1" seq="3"></Odometry>)x") == moving);
}

TEST_CASE("values may have units, a list one for all its numbers", "[text][xml]") {
  const auto goal = read<idl::GoalPoint>(
      R"x(<GoalPoint reach_angle="180 deg"><coordinate x="3600mm"/><reach_radius distance="30 cm"/></GoalPoint>)x");
  CHECK(goal.reach_radius().distance() == 0.3);
  CHECK(goal.reach_angle() == std::numbers::pi);
  CHECK(goal.coordinate().point().x() == 3.6);
  const auto readings = read<idl::LaserRangeReadings>(
      R"x(<LaserRangeReadings ranges="150 200 1500 mm" ranges_uncertainty="0.1 1cm" stamp="50 ms"/>)x");
  CHECK(readings.ranges() == std::vector<double>{0.15, 0.2, 1.5});
  CHECK(readings.ranges_uncertainty() == std::vector<double>{0.1, 0.01});
  CHECK(readings.stamp().ns() == 50'000'000);
  CHECK(read<idl::Drive>(R"x(<Drive steer_gain="1.5 1/s"/>)x").steer_gain() == 1.5);
  CHECK(read<idl::Battery>(R"x(<Battery charge="80 %" voltage="24100 mV"/>)x").charge() == 0.8);
}

TEST_CASE("a last number that equals the unit 1 is a number", "[text][xml]") {
  const auto bumpers = read<idl::BumperReadings>(R"x(<BumperReadings pressed="0 1 1"/>)x");
  CHECK(bumpers.pressed() == std::vector<std::uint8_t>{0, 1, 1});
}

TEST_CASE("the reader may leave the type open or demand one", "[text][xml]") {
  const auto any = reading("<Arrived name='lab'/>");
  REQUIRE(any.object);
  CHECK(&any.object->type() == &object_type<idl::Arrived>());
  CHECK_FALSE(reading("<Arrived name='lab'/>", &object_type<idl::GoalPoint>()).object);
}

TEST_CASE("an object within a sequence has the fields of its type", "[text][xml]") {
  const auto robot = read<idl::Robot>(
      R"x(<Robot name="Dewey" radius="19 cm"><drives type="SYNCHRO" max_speed="0.6"/><sonar_rings number="16"/></Robot>)x");
  REQUIRE(robot.drives().size() == 1);
  CHECK(robot.drives()[0].type() == idl::SYNCHRO);
  CHECK(robot.drives()[0].max_speed() == 0.6);
  REQUIRE(robot.sonar_rings().size() == 1);
  CHECK(robot.sonar_rings()[0].number() == 16);
}

TEST_CASE("to_xml of a view is that of its object", "[text][xml]") {
  const ObjectRef ref = ObjectPtr<idl::MotionCommand>(orca::full_stop());
  CHECK(to_xml(ref) == written(*object_cast<idl::MotionCommand>(ref)));
}

TEST_CASE("the examples of docs/objects.md can be read", "[text][xml][docs]") {
  std::ifstream page(std::string(ORCA_SOURCE_DIR) + "/docs/objects.md");
  int examples = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with('<') || line.starts_with("<!--")) continue;
    ++examples;
    CHECK(reading(line).errors == "");
  }
  CHECK(examples == 4);
}
