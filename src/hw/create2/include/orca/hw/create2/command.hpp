// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "orca/base/result.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/hw/framing/short_list.hpp"

/// The serial protocol of the iRobot Create 2 and of Roombas of the series 600: bytes to values and back, without
/// clock and I/O. All its functions are pure; any thread. The line has 115200 baud, 8 data bits, no parity, 1 stop bit.
/// Numbers of 16 bits have their high byte first.
/// @source  "iRobot Create 2 Open Interface (OI) Specification based on the iRobot Roomba 600", 2016.
namespace orca::hw::create2 {

inline constexpr int kBaud = 115200;
inline constexpr double kMaxWheelSpeed = 0.5;       ///< [m/s] in either direction.
inline constexpr double kWheelBase = 0.235;         ///< [m] between the drive wheels.
inline constexpr double kStreamPeriod = 0.015;      ///< [s] between frames of a stream.
inline constexpr std::size_t kLongestAnswer = 172;  ///< [bytes] that the line carries in kStreamPeriod.

/// A whole command, ready to be sent.
using Command = framing::FrameBytes<128>;

/// A command without arguments.
enum class Order : std::uint8_t {
  reset = 7,    ///< As after the battery was put in. The robot prints some lines of text; it takes seconds.
  start = 128,  ///< Opens the interface, in passive mode: sensors only. Must be the first command.
  safe =
      131,  ///< Safe mode: motors may be driven; the robot itself stops at cliffs, wheel drops and chargers.
  full = 132,   ///< Full mode: it does not.
  power = 133,  ///< Switches the robot off.
  dock = 143,   ///< Drives to the charger by itself.
  stop = 173,   ///< Closes the interface: streams end, motors stop.
};
[[nodiscard]] Command encode(Order order);

/// Returns a command to drive an arc.
/// @param speed  [m/s] of the robot's centre, forward positive, limited to kMaxWheelSpeed.
/// @param radius [m] of the arc, positive to the left, limited to [0.002, 2] in either direction; infinite: straight on.
///               If either is not a number the robot is told to stand.
[[nodiscard]] Command drive(double speed, double radius);

/// Returns a command to turn in place.
/// @param wheel_speed [m/s]  positive to the left, limited to kMaxWheelSpeed; not a number: stand.
[[nodiscard]] Command turn_in_place(double wheel_speed);

/// Speeds of both wheels [m/s], forward positive. A plain value.
struct WheelSpeeds {
  double left = 0.0;
  double right = 0.0;
  friend bool operator==(const WheelSpeeds&, const WheelSpeeds&) = default;
};

/// Returns the wheel speeds for a twist. If a wheel would exceed kMaxWheelSpeed, both are slowed down in proportion, so
/// that the robot keeps to its arc. A twist that is not finite gives 0.
/// @param twist  `left` is ignored: a Create cannot move sideways.
[[nodiscard]] WheelSpeeds wheel_speeds(const Twist2& twist);

/// Returns a command with the speed of each wheel, in whole mm/s.
/// @param speeds  Each limited to kMaxWheelSpeed; not a number: 0.
[[nodiscard]] Command drive_wheels(WheelSpeeds speeds);

/// Returns a command with the voltage of each motor.
/// @param left, right  Parts of the battery's voltage, forward positive, limited to [-1, 1]; not a number: 0.
[[nodiscard]] Command drive_pwm(double left, double right);

/// Returns a question for one packet or group of packets; the answer is its data alone: Sensors::apply().
/// @errors  invalid_argument if there is no such packet.
[[nodiscard]] Result<Command> ask_packet(std::uint8_t packet);

/// Returns a question for several; the answer is their data, one after the other: Sensors::apply_list().
/// @errors  invalid_argument if the list is empty or names a packet that does not exist, or if the answer would be longer
///          than kLongestAnswer.
[[nodiscard]] Result<Command> ask_list(std::span<const std::uint8_t> packets);

/// Returns the order to send these packets every kStreamPeriod, in frames as kProtocol finds them.
/// @errors  as those of ask_list().
[[nodiscard]] Result<Command> stream(std::span<const std::uint8_t> packets);

/// Returns a command that stops the stream, or lets it go on with the same packets.
[[nodiscard]] Command pause_stream();
[[nodiscard]] Command resume_stream();

}  // namespace orca::hw::create2
