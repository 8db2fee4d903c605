// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/hw/player/message.hpp"

namespace orca::hw::player {

/// What of the robot a device of a server is.
enum class Part : std::uint8_t { base, sonar, laser, bumper, power };

/// A device of a server that is used. A plain value.
struct Use {
  Part part = Part::base;
  Interface interface = Interface::position2d;
  std::uint32_t index = 0;
  friend bool operator==(const Use&, const Use&) = default;
};

/// Returns what a device is called in a server's configuration, for people: "position2d:0".
[[nodiscard]] std::string device_name(const Use& use);

/// Reads the parameter "uses": words with blanks between, such as "sonar laser=ranger:1 power". A part alone is the device 0 of its own
/// interface. A part that is named twice keeps its first device. The base comes first, even if it is not named.
/// @param faults  takes what cannot be understood, with what may be written.
[[nodiscard]] std::vector<Use> read_uses(const std::string& text, std::vector<HardwareFault>& faults);

}  // namespace orca::hw::player
