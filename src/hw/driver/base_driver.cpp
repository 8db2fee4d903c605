// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/base_driver.hpp"

#include "orca/idl/sensing.hpp"

namespace orca::hw {

BaseDriver::BaseDriver(HardwareHost& host, const std::string& usual_line, const link::Line& first,
                       const Kind& kind)
    : LineDriver(host, usual_line, first),
      kind_(kind),
      name_(*this, "name", kind.name, {.text = "Name of this robot, one word."}),
      max_speed_(*this, "max_speed", kind.usual.max_speed,
                 {.unit = "m/s",
                  .min = 0.0,
                  .max = kind.top_speed,
                  .text = kind.usual.type == idl::HOLONOMIC ? "Greatest speed, in whatever direction."
                                                            : "Greatest speed."}),
      max_turn_rate_(*this, "max_turn_rate", kind.usual.max_turn_rate,
                     {.unit = "rad/s", .min = 0.0, .max = kind.top_turn_rate, .text = "Greatest turn rate."}),
      max_command_age_(
          *this, "max_command_age", 0.2,
          {.unit = "s", .min = 0.02, .max = 1.0, .text = "Age of a command at which the base stops."}) {
  if (kind.in_file) figures_.emplace(*this);
}

std::vector<HardwareFault> BaseDriver::prepare() {
  std::vector<HardwareFault> faults = prepare_line();
  if (figures_)
    for (HardwareFault& fault : figures_->read(expected())) faults.push_back(std::move(fault));
  check(faults);
  if (!std::ranges::all_of(faults, &HardwareFault::only_warns)) return faults;
  for (SensorEndpoint* const sensor : make_senses()) add_sensor(*sensor);
  motion_.emplace(figures_ ? figures_->within(limits()) : limits(), from_seconds(*max_command_age_));
  set_motion(*motion_);
  return faults;
}

DriveLimits BaseDriver::limits() const {
  DriveLimits limits = kind_.usual;
  limits.max_speed = *max_speed_;
  limits.max_turn_rate = *max_turn_rate_;
  return limits;
}

idl::Robot BaseDriver::description() const {
  idl::Robot robot;
  robot.name(*name_);
  robot.drives().push_back(describe_wheels());
  robot.sensors() = describe_senses();
  describe(robot);
  return robot;
}

idl::Drive BaseDriver::describe_wheels() const {
  const DriveLimits& limits = motion_->limits();
  idl::Drive drive;
  drive.name("wheels");
  drive.port(device());
  drive.type(limits.type);
  drive.max_speed(limits.max_speed);
  drive.max_steer_speed(limits.max_turn_rate);
  drive.steer_gain(limits.steer_gain);
  drive.big_turn_angle(limits.big_turn_angle);
  drive.big_turn_speed(limits.big_turn_speed);
  return drive;
}

// Lasers and sonars have a description of their own.
std::vector<idl::Sensor> BaseDriver::describe_senses() const {
  std::vector<idl::Sensor> all;
  for (const SensorEndpoint* const endpoint : sensors()) {
    if (&endpoint->type() == &object_type<idl::LaserRangeReadings>() ||
        &endpoint->type() == &object_type<idl::SonarRangeReadings>())
      continue;
    idl::Sensor sensor;
    sensor.name(std::string(endpoint->type().name));
    sensor.port(device());
    sensor.type(std::string(endpoint->type().name));
    sensor.update_interval(to_seconds(endpoint->period()));
    all.push_back(sensor);
  }
  return all;
}

}  // namespace orca::hw
