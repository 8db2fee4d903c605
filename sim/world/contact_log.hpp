// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "physics.hpp"

namespace orca::sim::detail {

// Tells when a touch begins, once. It ends only when the two are well apart, because a robot that pushes
// against a wall hovers about distance zero; and Bullet knows no distance there, but only who is in contact.
// So it ends as soon as the robot has gone or turned away from where it was last in contact.
class ContactLog {
 public:
  // The pairs that began to touch in this tick.
  std::vector<Pair> update(const Physics& physics) {
    const std::map<Pair, double> near = physics.near_pairs();
    std::erase_if(touching_, [&](const auto& touch) {
      const auto now = near.find(touch.first);
      return now == near.end() ? apart(touch.second, physics.relative(touch.first)) : now->second > kApart;
    });
    std::vector<Pair> begun;
    for (const auto& [pair, distance] : near) {
      const bool known = touching_.contains(pair);
      if (!known && distance > kTouching) continue;
      if (!known) begun.push_back(pair);
      touching_[pair] = physics.relative(pair);
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

  static bool apart(const Pose2& before, const Pose2& now) {
    return norm(now.position() - before.position()) > kApart ||
           std::fabs(wrapped(now.yaw - before.yaw)) > kTurned;
  }

  std::map<Pair, Pose2> touching_;  // And how the two stood to each other when they were last in contact.
};

}  // namespace orca::sim::detail
