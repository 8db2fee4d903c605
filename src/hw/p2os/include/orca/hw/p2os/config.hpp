// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "orca/base/time.hpp"

namespace orca::hw::p2os {

/// Gains of one of the controller's two regulators, in its own units.
struct Gains {
  std::uint16_t proportional = 0;
  std::uint16_t derivative = 0;
  std::uint16_t integral = 0;
  friend bool operator==(const Gains&, const Gains&) = default;
};

/// Limits of one of the controller's two regulators: [m/s, m/s^2] of speeds, [rad/s, rad/s^2] of turn rates.
struct MotionLimits {
  double top_rate = 0.0;          ///< Highest that max_rate can be set to.
  double top_acceleration = 0.0;  ///< Highest that acceleration can be set to.
  double max_rate = 0.0;
  double acceleration = 0.0;
  double deceleration = 0.0;
};

/// The settings that the controller keeps in its memory: the answer to Command::config. Firmware that does not have
/// a field leaves it 0 or empty.
///
/// A plain value in SI units.
/// @source  ARCOS, "Configuration packet".
struct Config {
  std::string robot_class;
  std::string subclass;
  std::string serial_number;
  std::string name;
  std::string firmware_version;
  MotionLimits speed;      ///< Forward and backward.
  MotionLimits turn_rate;  ///< To the left and to the right.
  Gains speed_gains;
  Gains turn_rate_gains;
  std::uint16_t max_pwm = 0;  ///< [counts] power limit of the motors.
  Duration sip_cycle{0};      ///< [s] between two SIPs.
  Duration sonar_cycle{0};    ///< [s] between two sonars.
  Duration watchdog{0};       ///< [s] without a command after which the robot stops; 0: never, or not known.
  double low_battery_voltage = 0.0;    ///< [V] below which it warns.
  std::uint16_t shutdown_voltage = 0;  ///< Below which it switches off, in the controller's unit.
  std::uint8_t host_baud = 0;          ///< As the argument of Command::hostbaud.
  std::uint8_t aux1_baud = 0;          ///< As the argument of Command::hostbaud.
  std::uint8_t aux2_baud = 0;          ///< As the argument of Command::hostbaud.
  std::uint8_t aux3_baud = 0;          ///< As the argument of Command::hostbaud.
  bool resets_baud = false;            ///< The line returns to host_baud by itself when the connection ends.
  std::uint16_t gripper = 0;           ///< Kind of gripper; 0: none.
  bool has_front_sonar = false;
  bool has_rear_sonar = false;
  std::uint8_t front_bumpers = 0;     ///< Number of bumpers.
  std::uint8_t rear_bumpers = 0;      ///< Number of bumpers.
  std::uint8_t charger = 0;           ///< Kind of charger; 0: none.
  std::uint8_t gyro_type = 0;         ///< Kind of gyro; 0: none.
  std::uint16_t counts_per_turn = 0;  ///< Encoder counts of half a turn of the robot ("RevCount").
  std::uint16_t counts_per_millimetre = 0;
  std::int16_t drift_factor = 0;  ///< Correction of unequal wheels, in the controller's unit.
  bool sends_two_sips = false;    ///< Two SIPs in each cycle.
  std::uint16_t stall_value =
      0;  ///< [counts] of the motors' power, above which a wheel that stands is blocked.
  std::uint16_t stall_count = 0;    ///< For which the robot rests after that, in the controller's unit.
  double joystick_speed = 0.0;      ///< [m/s] at full deflection.
  double joystick_turn_rate = 0.0;  ///< [rad/s] at full deflection.
};

/// Reads a CONFIG packet. What it is too short for is 0 or empty.
/// @return  nothing if the body is of another type.
[[nodiscard]] std::optional<Config> parse_config(std::span<const std::uint8_t> body);

}  // namespace orca::hw::p2os
