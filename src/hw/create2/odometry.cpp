// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/create2/odometry.hpp"

#include <numbers>
#include <utility>

#include "orca/hw/create2/command.hpp"

namespace orca::hw::create2 {

int step_of(std::uint16_t previous, std::uint16_t next) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(next - previous));
}

double wheel_way(int counts) { return counts * (std::numbers::pi * kWheelDiameter / kCountsPerTurn); }

Travel2 EncoderOdometry::add(std::uint16_t left, std::uint16_t right) {
  const auto previous = std::exchange(previous_, Counts{left, right});
  if (!previous) return {};
  const double left_way = wheel_way(step_of(previous->left, left));
  const double right_way = wheel_way(step_of(previous->right, right));
  return {.forward = (left_way + right_way) / 2.0, .turn = (right_way - left_way) / kWheelBase};
}

}  // namespace orca::hw::create2
