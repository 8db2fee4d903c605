// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::robots::detail {
namespace {

DriveKind kind_of(const std::string& type) {
  if (type == "synchro") return DriveKind::synchro;
  return type == "holonomic" ? DriveKind::holonomic : DriveKind::differential;
}

}  // namespace

void read_drive(const xml::Attributes& e, Characteristics& model) {
  Drive& drive = model.drive;
  if (const auto type = e.choice("type")) drive.kind = kind_of(*type);
  set(drive.max_speed, e.number("max_speed"));
  set(drive.max_turn_rate, e.number("max_steer_speed"));
  set(drive.max_acceleration, e.number("max_acceleration"));
  set(drive.max_turn_acceleration, e.number("max_steer_acceleration"));
  set(drive.stop_deceleration, e.number_or("stop_deceleration", drive.stop_deceleration));
  set(drive.track, e.number("track"));
  set(drive.wheel_diameter, e.number("wheel_diameter"));
  set(drive.lag, e.duration_or("lag", drive.lag));
  set(drive.dead_time, e.duration_or("dead_time", drive.dead_time));
  set(drive.steer_gain, e.number_or("steer_gain", drive.steer_gain));
  set(drive.speed_step, e.number_or("speed_step", drive.speed_step));
  set(drive.big_turn_angle, e.number_or("big_turn_angle", drive.big_turn_angle));
  set(drive.big_turn_speed, e.number_or("big_turn_speed", drive.big_turn_speed));
  drive.label = read_label(e);
  if (drive.dead_time > std::chrono::seconds{5})
    e.error_at("dead_time", codes::kContradiction, "a dead time of more than 5 s is not simulated");
  if (drive.stop_deceleration > 0.0 && drive.stop_deceleration < drive.max_acceleration)
    e.error_at("stop_deceleration", codes::kContradiction,
               "an emergency stop must not be gentler than max_acceleration");
}

}  // namespace orca::robots::detail
