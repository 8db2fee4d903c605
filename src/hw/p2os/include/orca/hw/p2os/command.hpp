// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/hw/p2os/packet.hpp"

namespace orca::hw::p2os {

/// A command to the robot, of those that a driver needs. The numbers 0, 1 and 2 are SYNC0 to SYNC2 while the connection is not open: see sync().
/// @source  Pioneer 2 operations manual, table of client commands.
enum class Command : std::uint8_t {
  pulse = 0,      ///< Keeps the connection alive. No argument.
  open = 1,       ///< Starts the servers; SIPs follow. No argument, or any integer.
  close = 2,      ///< Stops everything and ends the connection. No argument, or any integer.
  enable = 4,     ///< Motor power: 1 on, 0 off.
  vel = 11,       ///< Speed, forward positive [mm/s].
  config = 18,    ///< 1: asks for one CONFIG packet.
  rvel = 21,      ///< Turn rate, counter-clockwise positive [deg/s].
  sonar = 28,     ///< All sonars: 1 on, 0 off.
  stop = 29,      ///< Stops; the motors stay enabled. No argument.
  gripper = 33,   ///< A GripperAction: see encode_gripper().
  hostbaud = 50,  ///< Rate of the line to the host: 0 to 4 = 9600, 19200, 38400, 57600, 115200 baud.
  estop = 55,     ///< Emergency stop, as hard as the motors can. No argument.
};

/// Returns a command without an argument.
[[nodiscard]] Packet encode(Command command);

/// Returns a command with an integer.
/// @param value  Limited to [-32768, 65535].
[[nodiscard]] Packet encode(Command command, int value);

/// Returns a step of the handshake, SYNC0 to SYNC2.
/// @pre  step is 0, 1 or 2.
[[nodiscard]] Packet sync(int step);

/// Returns Command::vel.
/// @param speed [m/s]  Forward positive, sent in whole mm/s. A speed that is not finite gives 0.
[[nodiscard]] Packet encode_speed(double speed);

/// Returns Command::rvel.
/// @param turn_rate [rad/s]  Positive to the left, sent in whole deg/s. A turn rate that is not finite gives 0.
[[nodiscard]] Packet encode_turn_rate(double turn_rate);

}  // namespace orca::hw::p2os
