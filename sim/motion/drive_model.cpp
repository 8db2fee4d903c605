// SPDX-License-Identifier: LGPL-3.0-or-later
#include "drive_model.hpp"

#include <algorithm>

#include "orca/base/portable_math.hpp"

namespace orca::sim::detail {
DriveModel::DriveModel(const Drive& drive, const ErrorLevels& errors, Duration tick)
    : drive_(drive), tick_s_(to_seconds(tick)) {
  const double lag_s = to_seconds(drive.lag) * errors.delay_scale;
  share_ = lag_s > 0.0 ? 1.0 - portable::exp(-tick_s_ / lag_s) : 1.0;
  const auto ticks = std::lround(to_seconds(drive.dead_time) * errors.delay_scale / tick_s_);
  pending_.resize(static_cast<std::size_t>(ticks) + 1);
}

void DriveModel::command(const Twist2& wanted) {
  const Vec2 way = shortened({wanted.forward, wanted.left}, drive_.max_speed);
  pending_.back().velocity = {way.x, way.y,
                              std::clamp(wanted.turn_rate, -drive_.max_turn_rate, drive_.max_turn_rate)};
  pending_.back().emergency_stop = false;
}

void DriveModel::emergency_stop() {
  pending_.back().velocity = {};
  pending_.back().emergency_stop = drive_.stop_deceleration > 0.0;
}

// Covers in this tick a share of the difference to the target, within the acceleration limits times their scale.
void DriveModel::follow(const Twist2& target, double share, double acceleration_scale) {
  const double longest = acceleration_scale * drive_.max_acceleration * tick_s_;
  const double widest = acceleration_scale * drive_.max_turn_acceleration * tick_s_;
  const Vec2 now{velocity_.forward, velocity_.left};
  const Vec2 way = now + shortened(share * (Vec2{target.forward, target.left} - now), longest);
  const double turn = std::clamp(share * (target.turn_rate - velocity_.turn_rate), -widest, widest);
  velocity_ = {way.x, way.y, velocity_.turn_rate + turn};
}

Twist2 DriveModel::step() {
  target_ = pending_.front();
  pending_.push_back(pending_.back());
  pending_.pop_front();
  if (target_.emergency_stop)
    follow({}, 1.0, drive_.stop_deceleration / drive_.max_acceleration);
  else
    follow(target_.velocity, share_, 1.0);
  return velocity_;
}

}  // namespace orca::sim::detail
