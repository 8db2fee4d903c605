// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/base.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orca::hw::nomad_scout {
namespace {

constexpr std::uint32_t kSign16 = 0x8000;
constexpr double kTenthOfDegree = std::numbers::pi / 1800.0;

int whole(double value) {
  return std::isfinite(value) ? static_cast<int>(std::lround(std::clamp(value, -32767.0, 32767.0))) : 0;
}

}  // namespace

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

int from_sign_and_magnitude(std::uint16_t bits) {
  const int magnitude = bits & (kSign16 - 1);
  return (bits & kSign16) != 0 ? -magnitude : magnitude;
}

std::uint16_t sign_and_magnitude(int value) {
  const int limited = std::clamp(value, -32767, 32767);
  return static_cast<std::uint16_t>(limited < 0 ? kSign16 + static_cast<unsigned>(-limited)
                                                : static_cast<unsigned>(limited));
}

int in_tenths_of_inch(double value) { return whole(value / kLengthUnit); }
double radians(int tenths_of_degree) { return tenths_of_degree * kTenthOfDegree; }

}  // namespace orca::hw::nomad_scout
