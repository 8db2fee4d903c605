// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::sim::detail {
namespace {

DriveKind kind_of(const std::string& type) {
  if (type == "synchro") return DriveKind::synchro;
  return type == "holonomic" ? DriveKind::holonomic : DriveKind::differential;
}

}  // namespace

void read_drive(const Attributes& e, RobotModel& model) {
  e.allow(
      {"type", "max_speed", "max_steer_speed", "max_acceleration", "max_steer_acceleration", "track",
       "wheel_diameter", "lag", "dead_time", "steer_gain", "speed_step", "big_turn_angle", "big_turn_speed"},
      {});
  Drive& drive = model.drive;
  if (const auto type = e.choice("type", {"differential", "synchro", "holonomic"}))
    drive.kind = kind_of(*type);
  set(drive.max_speed, e.quantity("max_speed", "m/s", Sign::positive));
  set(drive.max_steer_speed, e.quantity("max_steer_speed", "rad/s", Sign::positive));
  set(drive.max_acceleration, e.quantity("max_acceleration", "m/s2", Sign::positive));
  set(drive.max_steer_acceleration, e.quantity("max_steer_acceleration", "rad/s2", Sign::positive));
  set(drive.track, e.quantity("track", "m", Sign::positive));
  set(drive.wheel_diameter, e.quantity("wheel_diameter", "m", Sign::positive));
  set(drive.lag, e.duration_or("lag", drive.lag));
  set(drive.dead_time, e.duration_or("dead_time", drive.dead_time));
  set(drive.steer_gain, e.quantity_or("steer_gain", "", Sign::positive, drive.steer_gain));
  set(drive.speed_step, e.quantity_or("speed_step", "m/s", Sign::not_negative, drive.speed_step));
  set(drive.big_turn_angle, e.quantity_or("big_turn_angle", "rad", Sign::positive, drive.big_turn_angle));
  set(drive.big_turn_speed, e.quantity_or("big_turn_speed", "m/s", Sign::not_negative, drive.big_turn_speed));
  if (drive.dead_time > std::chrono::seconds{5})
    e.error_at("dead_time", 22, "a dead time of more than 5 s is not simulated");
}

}  // namespace orca::sim::detail
