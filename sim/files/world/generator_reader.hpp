// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "orca/sim/generate.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::sim::detail {

// The world that a <generate> asks for.
struct Order {
  Family family;
  std::uint64_t seed = 1;
  double radius = 0.3;  // [m]
};

// Reads a <generate>. Reports its errors and then returns nothing.
[[nodiscard]] std::optional<Order> read_generate(const xml::Attributes& element, xml::Reporter& reporter);

}  // namespace orca::sim::detail
