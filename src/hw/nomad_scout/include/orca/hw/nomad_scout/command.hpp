// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/nomad_scout/base.hpp"
#include "orca/hw/nomad_scout/packet.hpp"

/// Commands to a Scout. Unless it says otherwise, a command is answered by the state: parse_state(). Quantities are limited to what 15 bits
/// hold, and what is not finite counts as 0.
namespace orca::hw::nomad_scout {

/// Sets the accelerations of the wheels [m/s^2]; their signs are ignored.
[[nodiscard]] Packet set_accelerations(const Wheels& accelerations);
/// Sets the speeds of the wheels in move() [m/s]; their signs are ignored.
[[nodiscard]] Packet set_speeds(const Wheels& speeds);
/// Moves each wheel by a distance [m].
[[nodiscard]] Packet move(const Wheels& distances);
/// Drives with a speed per wheel [m/s].
[[nodiscard]] Packet drive(const Wheels& speeds);

/// Asks for the state.
[[nodiscard]] Packet get_state();
/// Stops and holds the position.
[[nodiscard]] Packet stop();
/// Takes the power from the motors.
[[nodiscard]] Packet limp();
/// Resets the configuration; it may take up to 120 s.
[[nodiscard]] Packet zero();

/// Sets the position that the robot believes to be at [m].
[[nodiscard]] Packet define_position(double x, double y);
/// Sets the heading that the robot believes to have, and the angle of a turret, which a Scout does not have [rad].
[[nodiscard]] Packet define_angles(double heading, double turret = 0.0);

/// Turns the sonars on, to fire one after the other in that order and then again.
/// @param interval [s]  Between two firings, in steps of 4 ms from 4 ms to 1.02 s.
/// @param order  Numbers of sonars; at most 16 are used.
[[nodiscard]] Packet start_sonars(Duration interval, std::span<const std::uint8_t> order);
/// Turns the sonars off.
[[nodiscard]] Packet stop_sonars();

/// Lets the robot stop when it hears no command for that long.
/// @param limit [s]  Rounded up to whole seconds, 1 to 255. 0 or less switches the watchdog off.
[[nodiscard]] Packet set_watchdog(Duration limit);

/// Asks for one group of readings: get_sonars, get_position, get_velocities, get_accelerations, get_bumpers or get_infrared,
/// which is the type of the answer too.
[[nodiscard]] Packet get_group(Type group);

/// Asks for an answer when the wheels stand, or when the time is over.
/// @param limit [s]  Rounded up to whole seconds, at most 255.
[[nodiscard]] Packet wait_until_stopped(bool right, bool left, Duration limit);

/// Sets the rate of a serial port of the controller.
/// @param baud  At most 65535.
[[nodiscard]] Packet configure_port(std::uint8_t port, std::uint16_t baud);

/// What an axis does in set_axes().
enum class AxisMode : std::uint8_t {
  ignore = 0,
  velocity = 1,
  relative_position = 2,
  limp = 3,
  set_acceleration = 4,
  set_speed = 5,
  absolute_position = 6,
  torque = 7,
  max_torque = 8,
};

/// A mode of an axis with its value, in the protocol's units: tenths of an inch, and seconds.
struct Axis {
  AxisMode mode = AxisMode::ignore;
  int value = 0;
};

/// Gives each axis a mode of its own: right wheel, left wheel, turret.
[[nodiscard]] Packet set_axes(const std::array<Axis, 3>& axes);

/// Sends bytes to a program of the user on the controller; answered by parse_special().
/// @errors  invalid_argument for more than fits into a packet.
[[nodiscard]] Result<Packet> special(std::span<const std::uint8_t> bytes);

}  // namespace orca::hw::nomad_scout
