// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/base/time.hpp"
#include "orca/hw/xr4000/base.hpp"
#include "orca/hw/xr4000/frame.hpp"

/// Requests to the agent.
namespace orca::hw::xr4000 {

/// Asks which version of the protocol the agent has, and what robot it serves.
[[nodiscard]] Frame hello();

/// Asks for readings: get_state, get_sonar, get_infrared, get_bumper, get_battery; or resets the motion timer. These requests have
/// no payload.
[[nodiscard]] Frame ask(Type type);

/// Drives all axes in velocity mode, in the robot frame.
/// @param speeds         [mm/s, mrad/s]
/// @param accelerations  [mm/s^2, mrad/s^2] also with which they brake.
[[nodiscard]] Frame drive(const Axes& speeds, const Axes& accelerations);

/// Sets the time without a reset of the motion timer after which the axes go limp.
/// @param limit [s]  in steps of 1 ms, at least one.
[[nodiscard]] Frame set_timer(Duration limit);

/// Sets the pose that the integrator counts on from.
[[nodiscard]] Frame set_integrator(const Axes& pose);

}  // namespace orca::hw::xr4000
