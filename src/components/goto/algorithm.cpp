// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orca::go {

double wrap(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

bool within_reach(const Target& target, const Pose& pose) {
  return std::hypot(target.x - pose.x, target.y - pose.y) < target.reach_radius;
}

Step step_towards(const Target& target, const Pose& pose, const Limits& limits, bool near) {
  if (near || within_reach(target, pose)) {
    const double off = wrap(target.orientation - pose.heading);
    if (target.use_orientation && !target.via && std::abs(off) > target.reach_angle)
      return {Step::Kind::turn, off, 0.0};
    return {Step::Kind::reached, 0.0, 0.0};
  }
  const double direction = wrap(std::atan2(target.y - pose.y, target.x - pose.x) - pose.heading);
  if (std::abs(direction) > limits.turn_in_place) return {Step::Kind::turn, direction, 0.0};
  const double distance = std::hypot(target.x - pose.x, target.y - pose.y);
  const double approach =
      target.via ? limits.max_speed : std::max(limits.min_speed, limits.slow_down * distance);
  const double aligned = std::max(0.0, std::cos(direction * (std::numbers::pi / 2) / limits.turn_in_place));
  return {Step::Kind::drive, direction, std::min(limits.max_speed, approach) * aligned};
}

}  // namespace orca::go
