// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/create2/command.hpp"

#include <algorithm>
#include <cmath>

namespace orca::hw::create2 {

namespace {

constexpr unsigned kDriveDirect = 145;
constexpr unsigned kStream = 148;

// In mm/s; 0 for what is not a number.
unsigned speed_of_wheel(double speed) {
  if (std::isnan(speed)) return 0;
  return static_cast<unsigned>(std::lround(1000.0 * std::clamp(speed, -kMaxWheelSpeed, kMaxWheelSpeed)));
}

void append_big_endian(Command& command, unsigned value) { command.u8(value >> 8).u8(value); }

}  // namespace

Command encode(Order order) {
  Command command;
  command.u8(static_cast<unsigned>(order));
  return command;
}

WheelSpeeds wheel_speeds(const Twist2& twist) {
  if (!is_finite(twist)) return {};
  const double difference = twist.turn_rate * kWheelBase / 2.0;
  const WheelSpeeds wished{twist.forward - difference, twist.forward + difference};
  const double fastest = std::max(std::abs(wished.left), std::abs(wished.right));
  if (!std::isfinite(fastest)) return {};
  if (fastest <= kMaxWheelSpeed) return wished;
  return {wished.left * (kMaxWheelSpeed / fastest), wished.right * (kMaxWheelSpeed / fastest)};
}

// The right wheel comes first.
Command drive_wheels(WheelSpeeds speeds) {
  Command command;
  command.u8(kDriveDirect);
  append_big_endian(command, speed_of_wheel(speeds.right));
  append_big_endian(command, speed_of_wheel(speeds.left));
  return command;
}

Command stream(std::span<const Packet> packets) {
  Command command;
  command.u8(kStream).u8(static_cast<unsigned>(packets.size()));
  for (const Packet packet : packets) command.u8(static_cast<unsigned>(packet));
  return command;
}

}  // namespace orca::hw::create2
