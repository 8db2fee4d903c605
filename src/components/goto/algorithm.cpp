// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/navigation/pure_pursuit.hpp"

namespace orca::go {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;

double bearing(const Target& target, const Pose2& pose) {
  return wrapped(portable::atan2(target.place.y - pose.y, target.place.x - pose.x) - pose.yaw);
}

Step drive(double direction, double speed, const Limits& limits) {
  if (std::abs(direction) > limits.turn_in_place) return {Step::Kind::turn, direction, 0.0};
  const double aligned = std::max(0.0, portable::cos(direction * kQuarterTurn / limits.turn_in_place));
  return {Step::Kind::drive, direction, std::min(limits.max_speed, speed) * aligned};
}

// Returns the largest speed on the way to a point that is passed [m/s]: behind it the way may lead anywhere.
double speed_before(const Target& target, const Pose2& pose, const Limits& limits) {
  const double left = std::max(0.0, distance(target, pose) - target.reach_radius);
  return std::sqrt(nav::kBendSpeed * nav::kBendSpeed + 2.0 * limits.deceleration * left);
}

// Returns the rate at which a robot that slides turns [rad/s].
double turn_while_sliding(const Target& target, const Pose2& pose) {
  constexpr double kTurnGain = 1.5;  // [1/s]
  constexpr double kFar = 0.5;       // [m] Nearer the direction to the target says little.
  if (target.use_orientation && !target.via) return kTurnGain * wrapped(target.orientation - pose.yaw);
  return distance(target, pose) > kFar ? kTurnGain * bearing(target, pose) : 0.0;
}

// Steers towards the circle from afar, along it (place on the left) when on it, and outwards from within it.
Step circle(const Target& target, const Pose2& pose, const Limits& limits) {
  const double inwards =
      portable::atan2(distance(target, pose) - limits.circle_radius, 0.5 * limits.circle_radius);
  return drive(wrapped(bearing(target, pose) - kQuarterTurn + inwards), limits.max_speed, limits);
}

}  // namespace

Step step_towards(const Target& target, const Pose2& pose, const Limits& limits, const Before& before) {
  const auto slide = [&](double speed, bool near) {
    return Step{Step::Kind::drive, bearing(target, pose), std::min(limits.max_speed, speed), near,
                turn_while_sliding(target, pose)};
  };
  if (const auto rest = step_of_rest(target, pose, limits.deceleration, before))
    return limits.slides && rest->kind == Step::Kind::drive ? slide(rest->speed, true) : *rest;
  if (target.reach_radius <= 0.0) return circle(target, pose, limits);
  const double approach = std::max(limits.min_speed, limits.slow_down * distance(target, pose));
  const double speed = target.via ? speed_before(target, pose, limits) : approach;
  return limits.slides ? slide(speed, false) : drive(bearing(target, pose), speed, limits);
}

}  // namespace orca::go
