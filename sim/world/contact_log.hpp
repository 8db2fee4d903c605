// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "physics.hpp"

namespace orca::sim::detail {

// Tells when a touch begins, once. It ends only when the two are well apart, because a robot that pushes
// against a wall hovers about distance zero.
class ContactLog {
 public:
  // The pairs that began to touch; `near` is what Physics::near_pairs() gave in this tick.
  std::vector<Pair> update(const std::map<Pair, double>& near) {
    std::erase_if(touching_, [&](const Pair& pair) {
      const auto now = near.find(pair);
      return now == near.end() || now->second > kApart;
    });
    std::vector<Pair> begun;
    for (const auto& [pair, distance] : near)
      if (distance <= kTouching && !std::ranges::binary_search(touching_, pair)) begun.push_back(pair);
    touching_.insert(touching_.end(), begun.begin(), begun.end());
    std::ranges::sort(touching_);
    return begun;
  }

  [[nodiscard]] bool touches(std::size_t robot) const {
    return std::ranges::any_of(touching_, [&](const Pair& pair) { return pair.robot == robot; });
  }

 private:
  static constexpr double kTouching = 0.0005;  // [m]
  static constexpr double kApart = 0.01;       // [m]
  std::vector<Pair> touching_;                 // Sorted.
};

}  // namespace orca::sim::detail
