// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"

namespace orca::go {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;

constexpr double kDrift = 1.5;  // reach radii from the target, beyond which a robot at rest approaches anew

double distance_in_space(const Target& target, const Pose2& pose) {
  return portable::hypot(target.place.x - pose.x, target.place.y - pose.y, target.rise);
}

double bearing(const Target& target, const Pose2& pose) {
  return wrapped(portable::atan2(target.place.y - pose.y, target.place.x - pose.x) - pose.yaw);
}

Step drive(double direction, double speed, const Limits& limits) {
  if (std::abs(direction) > limits.turn_in_place) return {Step::Kind::turn, direction, 0.0};
  const double aligned = std::max(0.0, portable::cos(direction * kQuarterTurn / limits.turn_in_place));
  return {Step::Kind::drive, direction, std::min(limits.max_speed, speed) * aligned};
}

// Steers towards the circle from afar, along it (place on the left) when on it, and outwards from within it.
Step circle(const Target& target, const Pose2& pose, const Limits& limits) {
  const double inwards =
      portable::atan2(distance(target, pose) - limits.circle_radius, 0.5 * limits.circle_radius);
  return drive(wrapped(bearing(target, pose) - kQuarterTurn + inwards), limits.max_speed, limits);
}

Step come_to_rest(const Target& target, const Pose2& pose, const Limits& limits, const Before& before) {
  const double speed = before.speed - limits.deceleration * before.time;
  if (speed > 0.0 && !target.via) return {Step::Kind::drive, 0.0, speed, true};
  const double off = wrapped(target.orientation - pose.yaw);
  if (target.use_orientation && !target.via && std::abs(off) > target.reach_angle)
    return {Step::Kind::turn, off, 0.0, true};
  return {Step::Kind::reached, 0.0, 0.0, true};
}

bool stays_near(const Target& target, const Pose2& pose, const Before& before) {
  return before.near && distance_in_space(target, pose) < kDrift * target.reach_radius;
}

}  // namespace

double distance(const Target& target, const Pose2& pose) {
  return portable::hypot(target.place.x - pose.x, target.place.y - pose.y);
}

bool within_reach(const Target& target, const Pose2& pose) {
  return distance_in_space(target, pose) < target.reach_radius;
}

Step step_towards(const Target& target, const Pose2& pose, const Limits& limits, const Before& before) {
  const bool in_reach = within_reach(target, pose);
  if (in_reach || stays_near(target, pose, before)) {
    const Step step = come_to_rest(target, pose, limits, before);
    if (in_reach || step.kind != Step::Kind::reached) return step;
  }
  if (target.reach_radius <= 0.0) return circle(target, pose, limits);
  const double approach = std::max(limits.min_speed, limits.slow_down * distance(target, pose));
  return drive(bearing(target, pose), target.via ? limits.max_speed : approach, limits);
}

}  // namespace orca::go
