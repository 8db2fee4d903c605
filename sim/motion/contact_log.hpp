// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "physics.hpp"

namespace orca::sim::detail {

// The touches that last, so that each is reported once, when it begins. A touch ends only when the two are
// well apart, because a robot that pushes against a wall comes off and on.
class ContactLog {
 public:
  // Returns the pairs that began to touch in this tick.
  std::vector<Pair> update(const Physics& physics) {
    const std::map<Pair, double>& near = physics.near_pairs();
    std::erase_if(touching_, [&](const Pair& pair) {
      const auto now = near.find(pair);
      return now == near.end() || now->second > kApart;
    });
    std::vector<Pair> begun;
    for (const auto& [pair, distance] : near)
      if (distance <= Physics::kTouching && touching_.insert(pair).second) begun.push_back(pair);
    return begun;
  }

  [[nodiscard]] bool touches(std::size_t robot) const {
    return std::ranges::any_of(touching_, [&](const Pair& pair) { return pair.robot == robot; });
  }

 private:
  static constexpr double kApart = 0.01;  // [m]

  std::set<Pair> touching_;
};

}  // namespace orca::sim::detail
