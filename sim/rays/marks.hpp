// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "orca/geometry/vec2.hpp"

namespace orca::sim::detail {

// Number of marks that are tested together.
inline constexpr std::size_t kMarkGroup = 8;

// Calls visit(number) for each of `count` things whose mark is 1 and not 0, in ascending order.
// @param marks  with room for a full last group, whose rest is overwritten.
template <class Visit>
void for_all_marked(std::int32_t* marks, std::size_t count, const Visit& visit) {
  const std::size_t end = (count + kMarkGroup - 1) / kMarkGroup * kMarkGroup;
  std::fill(marks + count, marks + end, 0);
  for (std::size_t group = 0; group < end; group += kMarkGroup) {
    std::array<std::uint64_t, kMarkGroup / 2> pairs{};
    std::memcpy(pairs.data(), marks + group, sizeof pairs);
    if ((pairs[0] | pairs[1] | pairs[2] | pairs[3]) == 0) continue;
    for (std::size_t i = group; i < group + kMarkGroup; ++i)
      if (marks[i] != 0) visit(i);
  }
}

inline float single(double value) { return static_cast<float>(value); }

// Returns a generous bound [m] on the rounding error of single precision near a place. A search that allows
// for it finds too many things rather than too few.
inline double single_margin(Vec2 place) { return 1e-3 + 1e-6 * (std::fabs(place.x) + std::fabs(place.y)); }

}  // namespace orca::sim::detail
