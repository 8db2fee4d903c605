// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "orca/geometry/twist2.hpp"
#include "orca/hw/create2/sensors.hpp"
#include "orca/hw/framing/short_list.hpp"

/// The serial protocol of the iRobot Create 2 and of Roombas of the series 600: bytes to values and back, without
/// clock and I/O. All its functions are pure; any thread. The line has 115200 baud, 8 data bits, no parity, 1 stop bit.
/// Numbers of 16 bits have their high byte first.
/// @source  "iRobot Create 2 Open Interface (OI) Specification based on the iRobot Roomba 600", 2016.
namespace orca::hw::create2 {

inline constexpr double kMaxWheelSpeed = 0.5;  ///< [m/s] in either direction.
inline constexpr double kWheelBase = 0.235;    ///< [m] between the drive wheels.

/// A whole command, ready to be sent.
using Command = framing::FrameBytes<128>;

/// A command without arguments.
enum class Order : std::uint8_t {
  start = 128,  ///< Opens the interface, in passive mode: sensors only. Must be the first command.
  safe =
      131,  ///< Safe mode: motors may be driven; the robot itself stops at cliffs, wheel drops and chargers.
  stop = 173,  ///< Closes the interface: streams end, motors stop.
};
[[nodiscard]] Command encode(Order order);

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

/// Returns the order to send these packets every 15 ms, in frames as kProtocol finds them.
/// @pre  the line carries them in that time, each after its number and 3 bytes around them: at 115200 baud up to 172 bytes.
[[nodiscard]] Command stream(std::span<const Packet> packets);

}  // namespace orca::hw::create2
