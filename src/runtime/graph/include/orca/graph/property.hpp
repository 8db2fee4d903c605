// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <variant>

namespace orca::graph {

/// A number and what it measures.
struct Quantity {
  double value = 0.0;  ///< In SI.
  std::string unit{};  ///< The SI unit; empty: a plain number.

  friend bool operator==(const Quantity&, const Quantity&) = default;
};

/// What a component exports about itself, by which others find it: a flag, a number or a text.
using PropertyValue = std::variant<bool, Quantity, std::string>;
using Properties = std::map<std::string, PropertyValue>;

}  // namespace orca::graph
