// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/hw/p2os/model.hpp"
#include "orca/hw/p2os/packet.hpp"

namespace orca::hw::p2os {

/// A command to the robot. The numbers 0, 1 and 2 are SYNC0 to SYNC2 while the connection is not open: see sync().
/// @source  Pioneer 2 operations manual, table of client commands.
enum class Command : std::uint8_t {
  pulse = 0,        ///< Keeps the connection alive. No argument.
  open = 1,         ///< Starts the servers; SIPs follow. No argument, or any integer.
  close = 2,        ///< Stops everything and ends the connection. No argument, or any integer.
  polling = 3,      ///< Firing sequence of the sonars: a byte per sonar, counted from 1.
  enable = 4,       ///< Motor power: 1 on, 0 off.
  seta = 5,         ///< Acceleration, negative: deceleration [mm/s^2].
  setv = 6,         ///< Highest speed [mm/s].
  seto = 7,         ///< Sets the odometry to 0, 0, 0. No argument.
  move = 8,         ///< Drives a distance [mm].
  rotate = 9,       ///< Turns [deg/s].
  setrv = 10,       ///< Highest turn rate [deg/s].
  vel = 11,         ///< Speed, forward positive [mm/s].
  head = 12,        ///< Turns to a heading, counter-clockwise positive [deg].
  dhead = 13,       ///< Turns by an angle, counter-clockwise positive [deg].
  config = 18,      ///< 1: asks for one CONFIG packet.
  encoder = 19,     ///< Encoder packets: 1 one, 2 continuously, 0 none.
  rvel = 21,        ///< Turn rate, counter-clockwise positive [deg/s].
  setra = 23,       ///< Rotational acceleration, negative: deceleration [deg/s^2].
  sonar = 28,       ///< All sonars: 1 on, 0 off.
  stop = 29,        ///< Stops; the motors stay enabled. No argument.
  digout = 30,      ///< High byte: lines to change; low byte: their states.
  vel2 = 32,        ///< Speeds of both wheels: see encode_wheels().
  gripper = 33,     ///< A GripperAction: see encode_gripper().
  adsel = 35,       ///< Analog port that SIPs report.
  gripperval = 36,  ///< Argument of the gripper command before.
  iorequest = 40,   ///< IO packets: 1 one, 2 continuously, 0 none.
  tty2 = 42,        ///< Bytes for the first auxiliary port.
  getaux = 43,      ///< Asks for 1 to 200 bytes of the first auxiliary port; 0 discards what it has received.
  bumpstall = 44,   ///< Bumpers that count as a stall: 0 none, 1 front, 2 rear, 3 both.
  joydrive = 47,    ///< Joystick of the robot: 1 allowed, 0 not.
  hostbaud = 50,    ///< Rate of the line to the host: 0 to 4 = 9600, 19200, 38400, 57600, 115200 baud.
  aux1baud = 51,    ///< Rate of the first auxiliary port.
  aux2baud = 52,    ///< Rate of the second auxiliary port.
  estop = 55,       ///< Emergency stop, as hard as the motors can. No argument.
  gyro = 58,        ///< Gyro packets: 1 on, 0 off.
  tty3 = 66,        ///< Bytes for the second auxiliary port.
  getaux2 = 67,     ///< As getaux, for the second auxiliary port.
  rotkp = 82,       ///< Gain of the turn controller: proportional.
  rotkv = 83,       ///< Gain of the turn controller: derivative.
  rotki = 84,       ///< Gain of the turn controller: integral.
  transkp = 85,     ///< Gain of the speed controller: proportional.
  transkv = 86,     ///< Gain of the speed controller: derivative.
  transki = 87,     ///< Gain of the speed controller: integral.
  reset = 253,      ///< As after power-on. No argument.
};

/// Most bytes that the argument of a command may have; controllers refuse packets of more than 198 bytes.
inline constexpr std::size_t kLongestArgument = 190;

/// Returns a command without an argument.
[[nodiscard]] Packet encode(Command command);

/// Returns a command with an integer.
/// @param value  Limited to [-32768, 65535]. Above 32767 it is a pattern of bits, as for Command::digout.
[[nodiscard]] Packet encode(Command command, int value);

/// Returns a command with a list of bytes.
/// @errors  invalid_argument for more than kLongestArgument bytes.
[[nodiscard]] Result<Packet> encode(Command command, std::span<const std::uint8_t> bytes);

/// Returns a step of the handshake, SYNC0 to SYNC2.
/// @pre  step is 0, 1 or 2.
[[nodiscard]] Packet sync(int step);

/// Returns Command::vel.
/// @param speed [m/s]  Forward positive, sent in whole mm/s. A speed that is not finite gives 0.
[[nodiscard]] Packet encode_speed(double speed);

/// Returns Command::rvel.
/// @param turn_rate [rad/s]  Positive to the left, sent in whole deg/s. A turn rate that is not finite gives 0.
[[nodiscard]] Packet encode_turn_rate(double turn_rate);

/// Speeds of both wheels in steps of Model::wheel_step, forward positive.
///
/// A plain value.
struct WheelSteps {
  int left = 0;
  int right = 0;
  friend bool operator==(const WheelSteps&, const WheelSteps&) = default;
};

inline constexpr int kMostWheelSteps = 126;  ///< In either direction.

/// Returns the steps nearest to a twist. If a wheel would need more than kMostWheelSteps, both are slowed down in
/// proportion, so that the robot keeps to its arc. A twist that is not finite gives 0.
/// @param twist  `left` is ignored: a Pioneer cannot move sideways.
[[nodiscard]] WheelSteps wheel_steps(const Twist2& twist, const Model& model);

/// Returns Command::vel2.
/// @param steps  Each limited to kMostWheelSteps.
[[nodiscard]] Packet encode_wheels(WheelSteps steps);

/// Returns the steps in the argument of Command::vel2, from whatever sender.
[[nodiscard]] WheelSteps wheel_steps_of(int argument);

/// A command as the robot receives it.
///
/// A plain value that refers to the body it was read from.
struct ReceivedCommand {
  /// What follows the number.
  enum class Argument {
    none,     ///< Nothing.
    integer,  ///< `value` is set.
    bytes,    ///< `bytes` is set.
    cut_short,  ///< Less than its type or its length promises, or an unknown type. `bytes` is what there is of a list.
  };
  std::uint8_t number = 0;  ///< A Command, or one that is not listed there.
  Argument argument = Argument::none;
  int value = 0;  ///< In [-65535, 65535].
  std::span<const std::uint8_t> bytes{};
};

/// Reads a command, for emulators and tests. Whoever carries it out should accept an argument that is missing or cut short: drivers in use
/// send such ones. Bytes behind the argument are ignored.
/// @param body  of a packet: see body_of().
/// @return  nothing for an empty body.
[[nodiscard]] std::optional<ReceivedCommand> decode_command(std::span<const std::uint8_t> body);

}  // namespace orca::hw::p2os
