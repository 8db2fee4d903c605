// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "physics.hpp"

namespace orca::sim::detail {

// Tells when a touch begins, once. It ends only when the two are well apart, because a robot that pushes
// against a wall hovers about distance zero; and Bullet knows no distance there, but only who is in contact.
// So it ends as soon as one of them has gone or turned away from where they were last in contact.
class ContactLog {
 public:
  // The pairs that began to touch in this tick.
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

  std::map<Pair, Standing> touching_;  // And how the two stood when they were last in contact.
};

}  // namespace orca::sim::detail
