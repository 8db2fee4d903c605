// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace orca::hw::p2os {

/// What a robot says of itself in answer to SYNC2.
///
/// A plain value.
struct Identity {
  std::string name;         ///< Given by its owner, e.g. "Pioneer2".
  std::string robot_class;  ///< e.g. "Pioneer".
  std::string subclass;     ///< The model, e.g. "p2dx": see choose_model().
  friend bool operator==(const Identity&, const Identity&) = default;
};

/// Returns the step of the handshake that a body answers, 0 to 2; nothing if it is no answer.
[[nodiscard]] std::optional<int> sync_step(std::span<const std::uint8_t> body);

/// Reads the answer to SYNC2. Texts that are missing are empty.
/// @return  nothing if the body is none.
[[nodiscard]] std::optional<Identity> parse_identity(std::span<const std::uint8_t> body);

}  // namespace orca::hw::p2os
