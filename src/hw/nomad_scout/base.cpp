// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/base.hpp"

#include <numbers>

namespace orca::hw::nomad_scout {

Wheels wheels_of(const Twist2& twist, double track) {
  const double turning = twist.turn_rate * track / 2.0;
  return {.left = twist.forward - turning, .right = twist.forward + turning};
}

Twist2 twist_of(const Wheels& speeds, double track) {
  return {.forward = (speeds.right + speeds.left) / 2.0, .turn_rate = (speeds.right - speeds.left) / track};
}

Pose2 sonar_pose(std::size_t number, double radius) {
  constexpr double kBetween = 2.0 * std::numbers::pi / kSonars;
  const double yaw = wrapped(static_cast<double>(number) * kBetween);
  const Vec2 position = radius * direction(yaw);
  return {position.x, position.y, yaw};
}

}  // namespace orca::hw::nomad_scout
