// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/target.hpp"

#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::go {
namespace {

constexpr double kDrift = 1.5;  // reach radii from the target, beyond which a robot at rest approaches again

double distance_in_space(const Target& target, const Pose2& pose) {
  return portable::hypot(target.place.x - pose.x, target.place.y - pose.y, target.rise);
}

Step come_to_rest(const Target& target, const Pose2& pose, double deceleration, const Before& before) {
  const double speed = before.speed - deceleration * before.time;
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

std::optional<Step> step_of_rest(const Target& target, const Pose2& pose, double deceleration,
                                 const Before& before) {
  const bool in_reach = within_reach(target, pose);
  if (!in_reach && !stays_near(target, pose, before)) return std::nullopt;
  const Step step = come_to_rest(target, pose, deceleration, before);
  return in_reach || step.kind != Step::Kind::reached ? std::optional(step) : std::nullopt;
}

}  // namespace orca::go
