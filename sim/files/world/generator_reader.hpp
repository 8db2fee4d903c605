// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "files/formats/attributes.hpp"
#include "orca/sim/generate.hpp"

namespace orca::sim::detail {

// What a <generate> asks for.
struct Order {
  Family family;
  std::uint64_t seed = 1;
  double radius = 0.3;  // [m]
};

// Reads a <generate>; nothing if something in it is wrong, which is told.
[[nodiscard]] std::optional<Order> read_generate(const Attributes& element);

// A seed: a whole number that is not negative.
[[nodiscard]] std::optional<std::uint64_t> read_seed(const Attributes& element);

}  // namespace orca::sim::detail
