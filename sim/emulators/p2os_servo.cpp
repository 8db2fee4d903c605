// SPDX-License-Identifier: LGPL-3.0-or-later
#include "p2os_servo.hpp"

#include <algorithm>
#include <cmath>

#include "orca/geometry/angle.hpp"

namespace orca::emulators {
namespace {

constexpr double kGain = 2.0;  // [1/s]
constexpr double kLeastSpeed = 0.02, kWayEnough = 0.005;
constexpr double kLeastTurnRate = 0.05, kHeadingEnough = 0.01;

// Returns the rate at which what is left is done, and 0 if so little is left that it is done.
double rate_for(double left, double least, double most, double enough) {
  if (std::abs(left) < enough) return 0.0;
  return std::copysign(std::clamp(kGain * std::abs(left), std::min(least, most), most), left);
}

}  // namespace

void P2osServo::move(double way, const Pose2& from) { goal_ = Goal{from, way}; }

void P2osServo::cease() {
  goal_.reset();
  heading_.reset();
}

Twist2 P2osServo::velocity(const Pose2& pose) {
  Twist2 velocity;
  if (goal_) {
    const double done = seen_from(goal_->from, pose).x;
    velocity.forward = rate_for(goal_->way - done, kLeastSpeed, speed_, kWayEnough);
    if (velocity.forward == 0.0) goal_.reset();
  }
  if (heading_) {
    velocity.turn_rate = rate_for(wrapped(*heading_ - pose.yaw), kLeastTurnRate, turn_rate_, kHeadingEnough);
    if (velocity.turn_rate == 0.0) heading_.reset();
  }
  return velocity;
}

}  // namespace orca::emulators
