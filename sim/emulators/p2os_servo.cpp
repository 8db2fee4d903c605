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

void P2osServo::drive(double speed) {
  way_.reset();
  velocity_.forward = speed;
}

void P2osServo::move(double distance, const Pose2& from) {
  way_ = Way{from, distance};
  velocity_.forward = 0.0;
}

void P2osServo::turn(double turn_rate) {
  heading_.reset();
  velocity_.turn_rate = turn_rate;
}

void P2osServo::turn_to(double heading) {
  heading_ = heading;
  velocity_.turn_rate = 0.0;
}

void P2osServo::stop() {
  drive(0.0);
  turn(0.0);
}

// The robot may turn while it covers a distance, so that is counted along its path.
Twist2 P2osServo::velocity(const Pose2& pose) {
  Twist2 velocity = velocity_;
  if (way_) {
    way_->left -= seen_from(way_->last, pose).x;
    way_->last = pose;
    velocity.forward = rate_for(way_->left, kLeastSpeed, move_speed_, kWayEnough);
    if (velocity.forward == 0.0) way_.reset();
  }
  if (heading_) {
    velocity.turn_rate =
        rate_for(wrapped(*heading_ - pose.yaw), kLeastTurnRate, heading_rate_, kHeadingEnough);
    if (velocity.turn_rate == 0.0) heading_.reset();
  }
  return velocity;
}

}  // namespace orca::emulators
