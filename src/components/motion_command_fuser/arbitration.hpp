// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "voice.hpp"

namespace orca::fuse {

/// Where one behaviour acts on the line of another: "avoid > goto".
struct Node {
  std::string higher;
  std::string lower;
};

/// Nothing if `text` is not of the form "higher > lower".
[[nodiscard]] std::optional<Node> parse_node(const std::string& text);

/// Of the behaviours that have a wish, the first in `order`; those that it does not name come after those
/// that it names, in the order in which they are given.
///
/// @param voices  none of them silent.
[[nodiscard]] std::size_t first_in_order(std::span<const Voice> voices,
                                         const std::vector<std::string>& order);

/// The wiring between the layers of a subsumption architecture. A suppressing behaviour puts its wish in the
/// place of the other's; an inhibiting one only silences the other. Either lasts until `hold` [s] after its
/// last wish. Nodes act in the order in which they are given: suppress, then inhibit.
struct Wiring {
  std::vector<Node> suppress;
  std::vector<Node> inhibit;
  double max_age = 0.0;  ///< [s] older wishes of the lines themselves do not count.
  double hold = 0.0;     ///< [s]
};

/// Which behaviour's wish comes out of the wiring: of the lines that suppress no other, the first that
/// carries a wish, in the order in which they are given. Nothing if no line carries any.
///
/// @source  Brooks, "A Robust Layered Control System for a Mobile Robot", IEEE J. Robotics and Automation
///          2(1), 1986: suppressor and inhibitor nodes with a time constant.
[[nodiscard]] std::optional<std::size_t> subsume(std::span<const Voice> voices, const Wiring& wiring);

}  // namespace orca::fuse
