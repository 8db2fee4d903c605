// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bumper_model.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/portable_math.hpp"

namespace orca::sim::detail {
namespace {

// A switch closes at a touch and opens a little after the touch ends, as a real one does. Without that it
// would flicker, because a robot that pushes against a wall hovers about distance zero.
constexpr double kTouching = 0.0005;  // [m]
constexpr double kReleased = 0.002;   // [m]

}  // namespace

BumperModel::BumperModel(BumperRing ring, TimePoint start)
    : ring_(std::move(ring)), due_(start + ring_.period), pressed_(ring_.count), felt_(ring_.count) {}

bool BumperModel::reaches(std::size_t segment, const Touch& touch) const {
  const double middle = ring_.segment(segment).yaw;
  const double off = wrapped(portable::atan2(touch.point.y, touch.point.x) - middle);
  return std::fabs(off) <= 0.5 * std::fabs(ring_.pitch) &&
         touch.distance <= (pressed_[segment] ? kReleased : kTouching);
}

void BumperModel::run(std::span<const Touch> touches, TimePoint now, const Pose2& X_RB) {
  completed_.reset();
  for (std::size_t k = 0; k < ring_.count; ++k) {
    pressed_[k] = std::ranges::any_of(touches, [&](const Touch& touch) { return reaches(k, touch); });
    if (pressed_[k]) felt_[k] = true;
  }
  if (now < due_) return;
  completed_ = BumperReading{now, std::exchange(felt_, std::vector<bool>(ring_.count)), X_RB};
  due_ += ring_.period;
}

}  // namespace orca::sim::detail
