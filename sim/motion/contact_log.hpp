// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "physics.hpp"

namespace orca::sim::detail {

// The touches that last, so that each is reported once, when it begins. A touch ends only when the two are
// well apart, because a robot that pushes against a wall hovers about distance zero. Bullet reports a
// distance only for near pairs. For other pairs the touch ends when one of the two has moved or turned away
// from the relative pose at which they were last near.
class ContactLog {
 public:
  // Returns the pairs that began to touch in this tick.
  std::vector<Pair> update(const Physics& physics) {
    const std::map<Pair, double> near = physics.near_pairs();
    std::erase_if(touching_, [&](const auto& touch) {
      const auto now = near.find(touch.first);
      return now == near.end() ? apart(touch.second, physics.standing(touch.first)) : now->second > kApart;
    });
    std::vector<Pair> begun;
    for (const auto& [pair, distance] : near) {
      const bool known = touching_.contains(pair);
      if (!known && distance > kTouching) continue;
      if (!known) begun.push_back(pair);
      touching_[pair] = physics.standing(pair);
    }
    return begun;
  }

  [[nodiscard]] bool touches(std::size_t robot) const {
    return std::ranges::any_of(touching_, [&](const auto& touch) { return touch.first.robot == robot; });
  }

 private:
  static constexpr double kTouching = 0.0005;  // [m]
  static constexpr double kApart = 0.01;       // [m]
  static constexpr double kTurned = 0.05;      // [rad]

  static bool apart(const Standing& before, const Standing& now) {
    return norm(now.apart - before.apart) > kApart ||
           std::fabs(wrapped(now.robot_yaw - before.robot_yaw)) > kTurned ||
           std::fabs(wrapped(now.other_yaw - before.other_yaw)) > kTurned;
  }

  std::map<Pair, Standing> touching_;  // With the relative pose at which the two were last near.
};

}  // namespace orca::sim::detail
