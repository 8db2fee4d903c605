// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "orca/hw/player/message.hpp"

/// Messages of the interface bumper.
namespace orca::hw::player {

/// BumperState.
inline constexpr MessageId kBumperState{Interface::bumper, MessageType::data, 1};

struct BumperState {
  static constexpr std::string_view kName = "bumper STATE";
  std::vector<std::uint8_t> pressed{};  ///< Of each bumper: 0 free, else pressed.
  friend bool operator==(const BumperState&, const BumperState&) = default;
};

}  // namespace orca::hw::player
