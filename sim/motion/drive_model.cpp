// SPDX-License-Identifier: LGPL-3.0-or-later
#include "drive_model.hpp"

#include <algorithm>

namespace orca::sim::detail {
namespace {

// Returns a vector of the same direction, not longer than `longest`.
Vec2 shortened(Vec2 v, double longest) {
  const double length = norm(v);
  return length > longest ? (longest / length) * v : v;
}

}  // namespace

DriveModel::DriveModel(const Drive& drive, const ErrorLevels& errors, Duration tick)
    : drive_(drive), tick_s_(to_seconds(tick)) {
  const double lag_s = to_seconds(drive.lag) * errors.delay_scale;
  share_ = lag_s > 0.0 ? 1.0 - std::exp(-tick_s_ / lag_s) : 1.0;
  const auto ticks = std::lround(to_seconds(drive.dead_time) * errors.delay_scale / tick_s_);
  pending_.resize(static_cast<std::size_t>(ticks) + 1);
}

void DriveModel::command(const Twist2& wanted) {
  const Vec2 way = shortened({wanted.forward, wanted.left}, drive_.max_speed);
  pending_.back().velocity = {way.x, way.y,
                              std::clamp(wanted.turn_rate, -drive_.max_turn_rate, drive_.max_turn_rate)};
}

double DriveModel::approach(double now, double target, double max_change) const {
  return now + std::clamp(share_ * (target - now), -max_change, max_change);
}

Vec2 DriveModel::approach(Vec2 now, Vec2 target, double max_change) const {
  return now + shortened(share_ * (target - now), max_change);
}

Twist2 DriveModel::step() {
  target_ = pending_.front();
  pending_.push_back(pending_.back());
  pending_.pop_front();
  const Twist2& target = target_.velocity;
  const Vec2 way = approach({velocity_.forward, velocity_.left}, {target.forward, target.left},
                            drive_.max_acceleration * tick_s_);
  velocity_ = {way.x, way.y,
               approach(velocity_.turn_rate, target.turn_rate, drive_.max_turn_acceleration * tick_s_)};
  return velocity_;
}

}  // namespace orca::sim::detail
