// SPDX-License-Identifier: LGPL-3.0-or-later
#include "drive_model.hpp"

#include <algorithm>

namespace orca::sim::detail {

DriveModel::DriveModel(const Drive& drive, const ErrorLevels& errors, Duration tick)
    : drive_(drive), tick_s_(to_seconds(tick)) {
  const double lag_s = to_seconds(drive.lag) * errors.delay_scale;
  share_ = lag_s > 0.0 ? 1.0 - std::exp(-tick_s_ / lag_s) : 1.0;
  const auto ticks = std::lround(to_seconds(drive.dead_time) * errors.delay_scale / tick_s_);
  pending_.resize(static_cast<std::size_t>(ticks) + 1);
}

void DriveModel::command(Velocity wanted) {
  pending_.back() = {std::clamp(wanted.forward, -drive_.max_speed, drive_.max_speed),
                     std::clamp(wanted.turn, -drive_.max_steer_speed, drive_.max_steer_speed)};
}

double DriveModel::approach(double now, double target, double max_change) const {
  return now + std::clamp(share_ * (target - now), -max_change, max_change);
}

Velocity DriveModel::step() {
  const Velocity target = pending_.front();
  pending_.push_back(pending_.back());
  pending_.pop_front();
  velocity_ = {approach(velocity_.forward, target.forward, drive_.max_acceleration * tick_s_),
               approach(velocity_.turn, target.turn, drive_.max_steer_acceleration * tick_s_)};
  return velocity_;
}

}  // namespace orca::sim::detail
