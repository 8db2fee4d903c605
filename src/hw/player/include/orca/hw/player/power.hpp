// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "orca/hw/player/message.hpp"

/// Messages of the interface power.
namespace orca::hw::player {

/// PowerState.
inline constexpr MessageId kPowerState{Interface::power, MessageType::data, 1};

/// State of a battery; what the server does not know is nothing.
struct PowerState {
  static constexpr std::string_view kName = "power STATE";
  std::optional<float> voltage{};          ///< [V]
  std::optional<float> charge{};           ///< [%] of a full battery.
  std::optional<float> energy{};           ///< [J] stored.
  std::optional<float> power{};            ///< [W] drawn.
  std::optional<std::int32_t> charging{};  ///< 1: it is being charged; 0: it is not.
  friend bool operator==(const PowerState&, const PowerState&) = default;
};

}  // namespace orca::hw::player
