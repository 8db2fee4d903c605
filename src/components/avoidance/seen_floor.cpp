// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/seen_floor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"

namespace orca::avoid {
namespace {

constexpr std::size_t kMostViews = 40;
constexpr double kWayBetween = 0.2;                     // [m] or
constexpr double kTurnBetween = 0.3;                    // [rad] from one kept scan to the next
constexpr double kFloorSector = std::numbers::pi / 72;  // [rad]
constexpr double kReadingError = 0.02;                  // [m]

bool is_nearly(const Pose2& one, const Pose2& other) {
  return norm(one.position() - other.position()) < kWayBetween &&
         std::abs(wrapped(one.yaw - other.yaw)) < kTurnBetween;
}

}  // namespace

void SeenFloor::note(const Scan& scan, const Pose2& X_OS) {
  const auto beams = scan.ranges.size();
  if (beams == 0 || scan.angle_increment <= 0.0 || (!views_.empty() && is_nearly(views_.back().X_OS, X_OS)))
    return;
  if (views_.size() == kMostViews) views_.pop_front();
  View& view = views_.emplace_back(View{X_OS, scan.angle_start});
  const double field = static_cast<double>(beams) * scan.angle_increment;
  view.free.assign(static_cast<std::size_t>(std::ceil(field / kFloorSector)), scan.max_range);
  for (std::size_t i = 0; i < beams; ++i) {
    const auto sector =
        static_cast<std::size_t>(static_cast<double>(i) * scan.angle_increment / kFloorSector);
    double& free = view.free[std::min(sector, view.free.size() - 1)];
    const double range = scan.ranges[i];
    free = range >= scan.min_range ? std::min(free, range) : 0.0;  // NaN and what is too near say nothing
  }
}

bool SeenFloor::has(Vec2 point) const {
  return std::ranges::any_of(views_, [&](const View& view) { return shows(view, point); });
}

bool SeenFloor::shows(const View& view, Vec2 point) {
  const Vec2 seen = seen_from(view.X_OS, point);
  double angle = portable::atan2(seen.y, seen.x) - view.start;
  angle -= 2.0 * std::numbers::pi * std::floor(angle / (2.0 * std::numbers::pi));
  const auto sector = static_cast<std::size_t>(angle / kFloorSector);
  return sector < view.free.size() && norm(seen) < view.free[sector] - kReadingError;
}

}  // namespace orca::avoid
