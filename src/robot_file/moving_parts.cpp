// SPDX-License-Identifier: LGPL-3.0-or-later
#include <numbers>
#include <string>
#include <utility>

#include "orca/geometry/usual_figures.hpp"
#include "part_readers.hpp"

namespace orca::robot_file {
std::string_view to_string(DriveKind kind) {
  switch (kind) {
    case DriveKind::differential: return "differential";
    case DriveKind::synchro: return "synchro";
    case DriveKind::holonomic: return "holonomic";
  }
  return "unknown";
}

constexpr double kWidestDrive = 4.0;  // times the robot's radius

void read_drive(const xml::Attributes& e, Devices& model) {
  Drive& drive = model.drive;
  const std::optional<std::string> type = e.choice("type");
  for (const DriveKind kind : {DriveKind::differential, DriveKind::synchro, DriveKind::holonomic})
    if (type == to_string(kind)) drive.kind = kind;
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
  for (const auto& [name, length] :
       {std::pair("track", drive.track), std::pair("wheel_diameter", drive.wheel_diameter)})
    if (model.radius > 0.0 && length > kWidestDrive * model.radius)
      e.error_at(name, codes::kContradiction,
                 std::string(name) +
                     " must be at most four times the robot's radius; a length without a unit is in metres");
  if (drive.big_turn_angle > 2.0 * std::numbers::pi)
    e.error_at("big_turn_angle", codes::kContradiction,
               "big_turn_angle must be at most a turn; an angle without a unit is in radians");
  if (drive.dead_time > std::chrono::seconds{5})
    e.error_at("dead_time", codes::kContradiction, "a dead time of more than 5 s is not simulated");
  if (drive.stop_deceleration > 0.0 && drive.stop_deceleration < drive.max_acceleration)
    e.error_at("stop_deceleration", codes::kContradiction,
               "an emergency stop must not be gentler than max_acceleration");
}

void read_turret(const xml::Attributes& e, Devices& model) {
  Turret turret;
  set(turret.joint, e.text("joint"));
  set(turret.max_speed, e.number("max_speed"));
  set(turret.max_acceleration, e.number("max_acceleration"));
  set(turret.period, e.duration("period"));
  if (turret.period > Duration{0}) check_period(e, turret.period);
  turret.label = read_label(e);
  model.turret = turret;
}

void read_gripper(const xml::Attributes& e, Devices& model) {
  Gripper gripper;
  set(gripper.link, e.text("link"));
  set(gripper.opening, e.number("opening"));
  set(gripper.depth, e.number("depth"));
  set(gripper.lift, e.number("lift"));
  set(gripper.paddle_time, e.duration("paddle_time"));
  set(gripper.lift_time, e.duration("lift_time"));
  set(gripper.period, e.duration("period"));
  if (gripper.period > Duration{0}) check_period(e, gripper.period);
  gripper.label = read_label(e);
  model.gripper = gripper;
}

void read_battery(const xml::Attributes& e, Devices& model) {
  Battery battery;
  const auto driving = e.duration("driving");
  const auto standing = e.duration("standing");
  const auto charging = e.duration("charging");
  set(battery.voltage, e.number("voltage"));
  set(battery.period, e.duration("period"));
  battery.label = read_label(e);
  if (battery.period > Duration{0}) check_period(e, battery.period);
  if (!driving || !standing || !charging) return;
  if (*standing < *driving)
    e.error_at("standing", codes::kContradiction,
               "a battery lasts at least as long at rest as while the robot drives");
  if (*charging >= *standing)
    e.error_at("charging", codes::kContradiction, "a charger must give more than the robot takes at rest");
  battery.driving = *driving;
  battery.standing = *standing;
  battery.charging = *charging;
  model.battery = battery;
}

void read_odometry(const xml::Attributes& e, Devices& model) {
  Guesses<WheelErrorGuess> errors = read_wheel_errors(e);
  if (!errors.is_known()) {
    errors.set(std::nullopt, kUsualWheelErrors);
    errors.set(Realism::harsh, kUsualHarshWheelErrors);
  }
  const auto period = e.duration("period");
  if (!period) return;
  check_period(e, *period);
  model.odometer = Odometer{*period, read_label(e), errors};
}

}  // namespace orca::robot_file
