// SPDX-License-Identifier: GPL-3.0-or-later
// What a client of a robot base is told that asks for a part of its description.
#include <catch2/catch.hpp>

#include "orca/hw/description.hpp"

using namespace orca;
using Catch::Contains;
using orca::hw::part_of;

namespace {

template <class Device>
Device named(const std::string& name) {
  Device device;
  device.name(name);
  return device;
}

template <class Device>
Device sensing(const std::string& name, const std::string& type) {
  Device sensor = named<Device>(name);
  sensor.type(type);
  return sensor;
}

// A Pioneer with two lasers, a ring of sonars, a bumper and a gripper.
idl::Robot pioneer() {
  idl::Robot robot;
  robot.name("Pioneer");
  robot.radius(0.3);
  robot.bumper_radius(0.35);
  robot.drives({named<idl::Drive>("drive")});
  robot.drives()[0].max_speed(1.5);
  robot.actuators({named<idl::Actuator>("gripper")});
  robot.sonar_rings({sensing<idl::SonarRing>("sonar", "SonarRangeReadings")});
  robot.laser_sensors({sensing<idl::LaserSensor>("front", "LaserRangeReadings"),
                       sensing<idl::LaserSensor>("back", "LaserRangeReadings")});
  robot.sensors({sensing<idl::Sensor>("bumper", "BumperReadings")});
  return robot;
}

struct Counts {
  std::size_t drives, actuators, sonars, lasers, sensors;
  friend bool operator==(const Counts&, const Counts&) = default;
};

Counts counts(const idl::Robot& robot) {
  return {robot.drives().size(), robot.actuators().size(), robot.sonar_rings().size(),
          robot.laser_sensors().size(), robot.sensors().size()};
}

Counts devices_in(const std::string& about) {
  const auto part = part_of(pioneer(), about);
  REQUIRE(part.has_value());
  CHECK((*part)->name() == "Pioneer");
  CHECK((*part)->radius() == 0.3);
  CHECK((*part)->bumper_radius() == 0.35);
  return counts(**part);
}

}  // namespace

TEST_CASE("whoever asks for nothing in particular gets the whole description", "[hw][description]") {
  CHECK(devices_in("") == Counts{1, 1, 1, 2, 1});
}

TEST_CASE("whoever asks for the limits gets the body and what moves, without the sensors",
          "[hw][description]") {
  CHECK(devices_in("limits") == Counts{1, 1, 0, 0, 0});
  CHECK((*part_of(pioneer(), "limits"))->drives()[0].max_speed() == 1.5);
}

TEST_CASE("whoever asks for one device gets the body and that device", "[hw][description]") {
  CHECK(devices_in("drive") == Counts{1, 0, 0, 0, 0});
  CHECK(devices_in("gripper") == Counts{0, 1, 0, 0, 0});
  CHECK(devices_in("sonar") == Counts{0, 0, 1, 0, 0});
  CHECK(devices_in("bumper") == Counts{0, 0, 0, 0, 1});
  CHECK(devices_in("back") == Counts{0, 0, 0, 1, 0});
  CHECK((*part_of(pioneer(), "back"))->laser_sensors()[0].name() == "back");
}

TEST_CASE("whoever asks for an object type gets all sensors that deliver it", "[hw][description]") {
  CHECK(devices_in("LaserRangeReadings") == Counts{0, 0, 0, 2, 0});
  CHECK(devices_in("SonarRangeReadings") == Counts{0, 0, 1, 0, 0});
}

TEST_CASE("a device that the robot does not have is refused with those that it has", "[hw][description]") {
  const auto part = part_of(pioneer(), "lasre");
  REQUIRE_FALSE(part.has_value());
  CHECK(part.error().code == Code::not_found);
  CHECK_THAT(part.error().message,
             Contains("\"lasre\"") && Contains("drive, gripper, sonar, front, back, bumper"));
}

TEST_CASE("what a driver leaves empty in its description is filled in with where it comes from", "[hw]") {
  idl::Robot robot = pioneer();
  robot.vendor("ActivMedia");
  robot.model("Pioneer 2-DX");
  robot.laser_sensors()[0].vendor("SICK");
  robot.laser_sensors()[0].port("/dev/ttyS1");
  orca::hw::complete(robot, {"p2os.so", "orca.hw.P2os", "/dev/ttyUSB0"});
  CHECK(robot.library() == "p2os.so");
  CHECK(robot.drives()[0].library() == "p2os.so");
  CHECK(robot.drives()[0].driver() == "orca.hw.P2os");
  CHECK(robot.actuators()[0].port() == "/dev/ttyUSB0");
  CHECK(robot.sonar_rings()[0].vendor() == "ActivMedia");
  CHECK(robot.sensors()[0].model() == "Pioneer 2-DX");
  CHECK(robot.laser_sensors()[0].vendor() == "SICK");
  CHECK(robot.laser_sensors()[0].port() == "/dev/ttyS1");
  CHECK(robot.laser_sensors()[1].driver() == "orca.hw.P2os");
}
