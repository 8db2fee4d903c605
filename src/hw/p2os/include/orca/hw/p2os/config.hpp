// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "orca/base/time.hpp"

namespace orca::hw::p2os {

/// What a driver needs of the settings that the controller keeps in its memory: of the answer to Command::config. Firmware that
/// does not have a field leaves it 0.
///
/// A plain value in SI units.
/// @source  ARCOS, "Configuration packet".
struct Config {
  double top_speed = 0.0;      ///< [m/s] Highest that the speed can be set to.
  double top_turn_rate = 0.0;  ///< [rad/s] Highest that the turn rate can be set to.
  Duration watchdog{0};        ///< [s] without a command after which the robot stops; 0: never, or not known.
  double low_battery_voltage = 0.0;  ///< [V] below which it warns.
  bool resets_baud = false;          ///< The line returns to its own rate by itself when the connection ends.
};

/// Reads a CONFIG packet. What it is too short for is 0.
/// @return  nothing if the body is of another type.
[[nodiscard]] std::optional<Config> parse_config(std::span<const std::uint8_t> body);

}  // namespace orca::hw::p2os
