// SPDX-License-Identifier: LGPL-3.0-or-later
#include "driver_fit.hpp"

#include <algorithm>

#include "orca/base/text.hpp"
#include "orca/hw/description.hpp"
#include "orca/xml/number.hpp"

namespace orca::host {
namespace {

using Texts = std::vector<std::string>;

std::string seconds(Duration time) { return xml::number_text(to_seconds(time)) + " s"; }

const hw::SensorEndpoint* sensor_like(const hw::SensorEndpoint& wanted,
                                      const hw::HardwareContainer& offered) {
  const auto found = std::ranges::find_if(offered.sensors(), [&](const hw::SensorEndpoint* sensor) {
    return sensor->port_stem() == wanted.port_stem() && sensor->source() == wanted.source();
  });
  return found == offered.sensors().end() ? nullptr : *found;
}

void compare_sensors(const hw::HardwareContainer& present, const hw::HardwareContainer& offered,
                     Texts& faults) {
  for (const hw::SensorEndpoint* const sensor : present.sensors()) {
    const std::string type = sensor->port_stem();
    const hw::SensorEndpoint* const other = sensor_like(*sensor, offered);
    if (other == nullptr) {
      faults.push_back(std::string("it has no ") +
                       (sensor->source() == hw::Source::truth ? "knowledge of the true " : "sensor of ") +
                       type);
    } else if (other->period() != sensor->period()) {
      faults.push_back("it delivers " + type + " every " + seconds(other->period()) +
                       ", and the present one every " + seconds(sensor->period()));
    }
  }
}

void compare_bases(const hw::HardwareContainer& present, const hw::HardwareContainer& offered,
                   Texts& faults) {
  if (present.motion() == nullptr) return;
  if (offered.motion() == nullptr) return faults.push_back("it moves nothing");
  const hw::DriveLimits& is = offered.motion()->limits();
  const hw::DriveLimits& was = present.motion()->limits();
  if (is.type != was.type)
    faults.push_back(std::string("its drive is ") + hw::name_of(is.type) + ", and the present one's is " +
                     hw::name_of(was.type));
}

void compare_actuators(const hw::HardwareContainer& present, const hw::HardwareContainer& offered,
                       Texts& faults) {
  for (const hw::ActuatorEndpoint* const actuator : present.actuators()) {
    const bool is_there = std::ranges::any_of(offered.actuators(), [&](const hw::ActuatorEndpoint* other) {
      return other->port_stem() == actuator->port_stem();
    });
    if (!is_there) faults.push_back("it has nothing that takes a " + actuator->port_stem());
  }
}

template <class Device>
void compare_devices(const std::vector<Device>& present, const std::vector<Device>& offered,
                     const std::string& kind, Texts& faults) {
  for (const Device& device : present) {
    const bool is_there =
        std::ranges::any_of(offered, [&](const Device& d) { return d.name() == device.name(); });
    if (!is_there) faults.push_back("it describes no " + kind + " " + in_quotes(device.name()));
  }
}

void compare_descriptions(const idl::Robot& present, const idl::Robot& offered, Texts& faults) {
  compare_devices(present.drives(), offered.drives(), "drive", faults);
  compare_devices(present.actuators(), offered.actuators(), "actuator", faults);
  compare_devices(present.sonar_rings(), offered.sonar_rings(), "ring of sonars", faults);
  compare_devices(present.laser_sensors(), offered.laser_sensors(), "laser", faults);
  compare_devices(present.sensors(), offered.sensors(), "sensor", faults);
}

}  // namespace

std::vector<std::string> driver_misfits(HardwareInstance& present, HardwareInstance& offered) {
  Texts faults;
  compare_sensors(present.container(), offered.container(), faults);
  compare_bases(present.container(), offered.container(), faults);
  compare_actuators(present.container(), offered.container(), faults);
  compare_descriptions(present.description(), offered.description(), faults);
  if (offered.robot() != present.robot() && !offered.robot().empty())
    faults.push_back("it moves the robot " + in_quotes(offered.robot()) + ", and the present one " +
                     in_quotes(present.robot()));
  return faults;
}

}  // namespace orca::host
