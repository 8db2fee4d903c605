// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// A turret under position control. It turns to its angle with full acceleration, at most at full speed, and
// brakes to stop there. Angles are those of the turret relative to the body.
class TurretModel {
 public:
  explicit TurretModel(const Turret& turret) : turret_(turret) {}

  // Turns for one tick of `seconds` towards a moving target: its angle `target` [rad] at the tick's end, and
  // its rate `target_rate` [rad/s].
  void step(double target, double target_rate, double seconds) {
    const double off = wrapped(target - target_rate * seconds - angle_);
    // Braking from rate r with acceleration a takes the angle r^2 / 2a. Half a tick's change of rate is kept
    // in reserve, because time advances in ticks.
    const double step_rate = 0.5 * turret_.max_acceleration * seconds;
    const double braking =
        std::sqrt(step_rate * step_rate + 2.0 * turret_.max_acceleration * std::fabs(off)) - step_rate;
    const double closing = std::copysign(std::min(braking, std::fabs(off) / seconds), off);
    const double wanted = std::clamp(target_rate + closing, -turret_.max_speed, turret_.max_speed);
    const double most = turret_.max_acceleration * seconds;
    rate_ += std::clamp(wanted - rate_, -most, most);
    angle_ = wrapped(angle_ + rate_ * seconds);
  }

  [[nodiscard]] double angle() const { return angle_; }  // [rad] In (-pi, pi].
  [[nodiscard]] double rate() const { return rate_; }    // [rad/s]
  [[nodiscard]] Vec2 axis() const { return turret_.axis; }

 private:
  Turret turret_;
  double angle_ = 0.0;
  double rate_ = 0.0;
};

}  // namespace orca::sim::detail
