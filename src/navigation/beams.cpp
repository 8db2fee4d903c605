// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/beams.hpp"

#include <algorithm>
#include <cmath>

#include "orca/navigation/pose_history.hpp"

namespace orca::nav {

void beams_of(const SweptScan& scan, double range, std::vector<Beam>& beams) {
  beams.clear();
  const double last = std::max(1.0, static_cast<double>(scan.ranges.size()) - 1.0);
  const double farthest = std::min(range, scan.max_range);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (std::isnan(scan.ranges[i])) continue;  // it says nothing, not even that the way is free
    const auto number = static_cast<double>(i);
    const Pose2 sensor = between(scan.X_MS_first, scan.X_MS_last, number / last);
    const bool echo = scan.ranges[i] < farthest;
    const double length = echo ? std::max(scan.ranges[i], scan.min_range) : farthest;
    const double yaw = sensor.yaw + scan.angle_start + number * scan.angle_increment;
    beams.push_back({sensor.position(), sensor.position() + length * direction(yaw), echo});
  }
}

}  // namespace orca::nav
