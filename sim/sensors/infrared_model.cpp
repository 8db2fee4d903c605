// SPDX-License-Identifier: LGPL-3.0-or-later
#include "infrared_model.hpp"

#include <algorithm>
#include <utility>

namespace orca::sim::detail {
namespace {

constexpr int kRays = 5;  // Number of rays across the beam, including its rims.

}  // namespace

InfraredModel::InfraredModel(InfraredRing ring, const ErrorLevels& errors, RandomStream random,
                             TimePoint start)
    : ring_(std::move(ring)), errors_(errors), random_(random), due_(start + ring_.period) {}

void InfraredModel::run(const Caster& caster, std::size_t own_body, const TickSpan& span) {
  completed_.reset();
  if (due_ > span.to) return;
  const Pose2 X_WB = span.at(due_);
  InfraredScan scan{due_, {}, span.in_robot(due_)};
  for (std::size_t k = 0; k < ring_.count; ++k)
    scan.ranges.push_back(measured(closest(caster, own_body, X_WB * ring_.sensor(k))));
  completed_ = std::move(scan);
  due_ += ring_.period;
}

double InfraredModel::closest(const Caster& caster, std::size_t own_body, const Pose2& X_WS) const {
  double range = ring_.max_range;
  for (int i = 0; i < kRays; ++i) {
    const double angle = X_WS.yaw + ring_.half_beam * (2.0 * i / (kRays - 1) - 1.0);
    range = std::min(
        range,
        caster.cast({X_WS.position(), direction(angle), ring_.max_range, ring_.height, own_body}).range);
  }
  return range;
}

double InfraredModel::measured(double range) {
  const double noise = random_.normal(0.0, errors_.infrared_noise);
  if (range >= ring_.max_range) return ring_.max_range;
  return std::clamp(range + noise * range * range, ring_.min_range, ring_.max_range);
}

}  // namespace orca::sim::detail
