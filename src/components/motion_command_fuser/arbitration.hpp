// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "voice.hpp"

namespace orca::fuse {

/// A place where one behaviour acts on the line of another: "avoid > goto".
struct Node {
  std::string higher;
  std::string lower;
};

/// Reads a node; returns nothing if `text` is not of the form "higher > lower".
[[nodiscard]] std::optional<Node> parse_node(const std::string& text);

/// Returns the behaviour with a wish that comes first in `order`. Behaviours that `order` does not name come
/// after those that it names, in the order in which they are given.
///
/// @param voices  none of them silent.
[[nodiscard]] std::size_t first_in_order(std::span<const Voice> voices,
                                         const std::vector<std::string>& order);

/// The wiring between the layers of a subsumption architecture. A suppressing behaviour replaces the wish of
/// the other by its own; an inhibiting one only silences the other. Either lasts until `hold` [s] after its
/// last wish. Nodes act in the order in which they are given: suppress, then inhibit.
struct Wiring {
  std::vector<Node> suppress;
  std::vector<Node> inhibit;
  double max_age = 0.0;  ///< [s] older wishes of the lines themselves do not count.
  double hold = 0.0;     ///< [s]
};

/// Returns the behaviour whose wish comes out of the wiring. It is the first line that suppresses no other
/// and carries a wish, in the order in which the lines are given. Returns nothing if no line carries any.
///
/// @source  Brooks, "A Robust Layered Control System for a Mobile Robot", IEEE J. Robotics and Automation
///          2(1), 1986: suppressor and inhibitor nodes with a time constant.
[[nodiscard]] std::optional<std::size_t> subsume(std::span<const Voice> voices, const Wiring& wiring);

}  // namespace orca::fuse
