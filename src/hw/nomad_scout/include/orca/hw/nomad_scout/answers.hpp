// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "orca/hw/nomad_scout/state.hpp"

namespace orca::hw::nomad_scout {

/// The answer to Type::get_sonars.
struct SonarAnswer {
  SonarRanges sonars{};
  Duration controller_time{};
};

/// The answer to Type::get_position.
struct PositionAnswer {
  RawPosition position{};
  double heading = 0.0;  ///< [rad] in (-pi, pi].
  double turret = 0.0;   ///< [rad] in (-pi, pi].
};

/// The answer to Type::get_bumpers.
struct BumperAnswer {
  std::uint32_t bumpers = 0;
  Duration controller_time{};
};

/// Each of these returns nothing if the message has another type or is too short.
[[nodiscard]] std::optional<SonarAnswer> parse_sonars(const Message& message);
[[nodiscard]] std::optional<PositionAnswer> parse_position(const Message& message);
[[nodiscard]] std::optional<Wheels> parse_velocities(const Message& message);
[[nodiscard]] std::optional<BumperAnswer> parse_bumpers(const Message& message);

/// Returns the bytes that a program of the user has answered to special().
[[nodiscard]] std::optional<std::span<const std::uint8_t>> parse_special(const Message& message);

}  // namespace orca::hw::nomad_scout
