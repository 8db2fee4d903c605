// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/laser_driver.hpp"

#include <algorithm>
#include <limits>

#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/ranges.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw {
namespace {

constexpr Duration kLook = 100ms;  // between two looks, if input wakes nobody sooner
constexpr Duration kLookWithoutWaking = 5ms;

}  // namespace

LaserDriver::LaserDriver(HardwareHost& host, const link::Line& first, const Kind& kind)
    : LineDriver(host, "/dev/ttyUSB0", first),
      kind_(kind),
      name_(*this, "name", "laser", {.text = "Name of this laser, one word."}),
      place_(*this, kind.direction) {}

std::vector<HardwareFault> LaserDriver::prepare() {
  std::vector<HardwareFault> faults = prepare_line();
  for (HardwareFault& fault : place_.read()) faults.push_back(std::move(fault));
  check(faults);
  if (!faults.empty()) return faults;
  endpoint_.emplace(scans().period);
  add_sensor(*endpoint_);
  return faults;
}

idl::Robot LaserDriver::description() const {
  const Scans scans = this->scans();
  idl::LaserSensor laser;
  laser.name(*name_);
  laser.vendor(kind_.vendor);
  laser.model(kind_.model);
  laser.port(device());
  laser.type(std::string(endpoint_->type().name));
  laser.update_interval(to_seconds(scans.period));
  laser.mount(level_frame(place_.place(), place_.height()));
  laser.number(static_cast<std::uint32_t>(scans.beams));
  laser.angle_start(place_.sense() * scans.first_angle);
  laser.angle_increment(place_.sense() * scans.increment);
  laser.min_range(scans.min_range);
  laser.max_range(scans.max_range);
  idl::Robot robot;
  robot.name(*name_);
  robot.vendor(kind_.vendor);
  robot.model(kind_.model);
  robot.laser_sensors().push_back(laser);
  return robot;
}

void LaserDriver::publish(std::span<const double> ranges, TimePoint stamp, double time_increment) {
  const Scans scans = this->scans();
  auto object = endpoint_->loan();
  object->ranges().assign(ranges.begin(), ranges.end());
  for (std::size_t k = 0; k < ranges.size(); ++k)
    if (place_.ignores(place_.sense() * (scans.first_angle + static_cast<double>(k) * scans.increment)))
      object->ranges()[k] = std::numeric_limits<double>::quiet_NaN();
  object->min_range(scans.min_range);
  object->max_range(scans.max_range);
  object->pose(level_pose(place_.place(), place_.height(), stamp));
  object->stamp(to_time_value(stamp));
  object->angle_start(place_.sense() * scans.first_angle);
  object->angle_increment(place_.sense() * scans.increment);
  object->time_increment(time_increment);
  set_uncertainty(*object, place_.errors());
  endpoint_->publish(std::move(object));
}

Status LaserDriver::poll() {
  looked_ = host().now();
  const Status looked = look(looked_);
  return looked.ok() ? line().flush() : looked;
}

// A line without a descriptor wakes nobody.
TimePoint LaserDriver::next_step() const {
  return line().descriptor() < 0 ? host().now() : LineDriver::next_step();
}

TimePoint LaserDriver::next_turn() const {
  const Duration look = line().descriptor() < 0 ? kLookWithoutWaking : kLook;
  return std::min(looked_ + look, LineDriver::next_step());
}

Status LaserDriver::drive(const DriveSetpoint& /*setpoint*/) {
  return fail(Code::failed_precondition, "a laser does not move");
}

}  // namespace orca::hw
