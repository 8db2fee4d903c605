// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "orca/base/time.hpp"
#include "orca/hw/nomad_scout/base.hpp"
#include "orca/hw/nomad_scout/packet.hpp"

/// Commands to a Scout. Each is answered by the state: parse_state(). Quantities are limited to what 15 bits
/// hold, and what is not finite counts as 0.
namespace orca::hw::nomad_scout {

/// Sets the accelerations of the wheels [m/s^2]; their signs are ignored.
[[nodiscard]] Packet set_accelerations(const Wheels& accelerations);
/// Drives with a speed per wheel [m/s].
[[nodiscard]] Packet drive(const Wheels& speeds);

/// Asks for the state.
[[nodiscard]] Packet get_state();
/// Stops and holds the position.
[[nodiscard]] Packet stop();
/// Takes the power from the motors.
[[nodiscard]] Packet limp();
/// Turns the sonars on, to fire one after the other in that order and then again.
/// @param interval [s]  Between two firings, in steps of 4 ms from 4 ms to 1.02 s.
/// @param order  Numbers of sonars; at most 16 are used.
[[nodiscard]] Packet start_sonars(Duration interval, std::span<const std::uint8_t> order);
/// Turns the sonars off.
[[nodiscard]] Packet stop_sonars();

/// Lets the robot stop when it hears no command for that long.
/// @param limit [s]  Rounded up to whole seconds, 1 to 255. 0 or less switches the watchdog off.
[[nodiscard]] Packet set_watchdog(Duration limit);

}  // namespace orca::hw::nomad_scout
