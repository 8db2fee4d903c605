// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/odometry.hpp"

namespace orca::hw::p2os {

int step_of(std::uint16_t previous, std::uint16_t next) {
  constexpr int kTurn = 32768;
  const int forward = (next - previous) & (kTurn - 1);
  return forward < kTurn / 2 ? forward : forward - kTurn;
}

Vec2 WheelOdometry::add(std::uint16_t x, std::uint16_t y) {
  const Counts now{x, y};
  const Counts before = previous_.value_or(now);
  previous_ = now;
  return {distance_unit_ * step_of(before.x, now.x), distance_unit_ * step_of(before.y, now.y)};
}

}  // namespace orca::hw::p2os
