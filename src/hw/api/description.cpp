// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/description.hpp"

#include <vector>

#include "orca/base/text.hpp"

namespace orca::hw {
namespace {

template <class Device>
std::size_t keep_named(std::vector<Device>& devices, const std::string& name) {
  std::erase_if(devices, [&](const Device& device) { return device.name() != name; });
  return devices.size();
}

template <class Device>
std::size_t keep_sensing(std::vector<Device>& sensors, const std::string& about) {
  std::erase_if(sensors,
                [&](const Device& sensor) { return sensor.name() != about && sensor.type() != about; });
  return sensors.size();
}

void drop_sensors(idl::Robot& robot) {
  robot.sonar_rings().clear();
  robot.laser_sensors().clear();
  robot.sensors().clear();
}

// Returns how many devices are left.
std::size_t keep(idl::Robot& robot, const std::string& about) {
  return keep_named(robot.drives(), about) + keep_named(robot.actuators(), about) +
         keep_sensing(robot.sonar_rings(), about) + keep_sensing(robot.laser_sensors(), about) +
         keep_sensing(robot.sensors(), about);
}

template <class Device>
void add_names(const std::vector<Device>& devices, std::vector<std::string>& names) {
  for (const Device& device : devices) names.push_back(device.name());
}

Error not_there(const idl::Robot& robot, const std::string& about) {
  std::vector<std::string> names;
  add_names(robot.drives(), names);
  add_names(robot.actuators(), names);
  add_names(robot.sonar_rings(), names);
  add_names(robot.laser_sensors(), names);
  add_names(robot.sensors(), names);
  return fail(Code::not_found,
              "the robot has no " + in_quotes(about) +
                  "; ask for nothing in particular, for limits, for the object type of a sensor, or for: " +
                  listed(names));
}

// Returns the text, or another one if it is empty.
const std::string& either(const std::string& text, const std::string& otherwise) {
  return text.empty() ? otherwise : text;
}

template <class Device>
void complete_all(std::vector<Device>& devices, const idl::Robot& robot, const DriverOrigin& origin) {
  for (Device& device : devices) {
    device.library(either(device.library(), origin.library));
    device.driver(either(device.driver(), origin.driver));
    device.port(either(device.port(), origin.line));
    device.vendor(either(device.vendor(), robot.vendor()));
    device.model(either(device.model(), robot.model()));
  }
}

}  // namespace

void complete(idl::Robot& robot, const DriverOrigin& origin) {
  robot.library(either(robot.library(), origin.library));
  complete_all(robot.drives(), robot, origin);
  complete_all(robot.actuators(), robot, origin);
  complete_all(robot.sonar_rings(), robot, origin);
  complete_all(robot.laser_sensors(), robot, origin);
  complete_all(robot.sensors(), robot, origin);
}

Result<Loan<idl::Robot>> part_of(const idl::Robot& robot, const std::string& about) {
  Loan<idl::Robot> part = make_object<idl::Robot>(robot);
  if (about.empty()) return part;
  if (about == "limits") {
    drop_sensors(*part);
    return part;
  }
  if (keep(*part, about) == 0) return not_there(robot, about);
  return part;
}

const char* name_of(idl::DriveType type) {
  switch (type) {
    case idl::DIFFERENTIAL: return "differential";
    case idl::SYNCHRO: return "synchro";
    case idl::HOLONOMIC: return "holonomic";
  }
  return "unknown";
}

}  // namespace orca::hw
