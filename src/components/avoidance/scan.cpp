// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/scan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace orca::avoid {
namespace {

// Where a beam ends; nothing if it met nothing.
std::optional<Echo> place_of(const Scan& scan, std::size_t i) {
  const double yaw = scan.mount.yaw + scan.angle_start + scan.angle_increment * static_cast<double>(i);
  return echo_of(scan.ranges[i], scan.min_range, scan.max_range, {scan.mount.x, scan.mount.y, yaw});
}

double distance(const Echo& echo) { return std::hypot(echo.x, echo.y); }

bool in_view(const Scan& scan, const Echo& echo) {
  const Echo seen = seen_after(echo, scan.mount);
  const double width = scan.angle_increment * static_cast<double>(scan.ranges.size() - 1);
  const double middle = scan.angle_start + 0.5 * width;
  const double off = std::remainder(std::atan2(seen.y, seen.x) - middle, 2.0 * std::numbers::pi);
  return distance(seen) < scan.max_range && std::abs(off) <= 0.5 * std::abs(width);
}

}  // namespace

void see(const Scan& scan, double sector, double range, const EchoMemory::Limits& keep, EchoMemory& memory) {
  if (scan.ranges.empty()) return;
  memory.forget_if([&](const Echo& echo) { return in_view(scan, echo); });
  const double beams = sector / std::max(std::abs(scan.angle_increment), 1e-9);
  const auto step = static_cast<std::size_t>(std::clamp(beams, 1.0, static_cast<double>(scan.ranges.size())));
  for (std::size_t first = 0; first < scan.ranges.size(); first += step) {
    std::optional<Echo> nearest;
    for (std::size_t i = first; i < std::min(first + step, scan.ranges.size()); ++i) {
      const std::optional<Echo> place = place_of(scan, i);
      if (place && (!nearest || distance(*place) < distance(*nearest))) nearest = place;
    }
    if (nearest && distance(*nearest) < range) memory.hear(*nearest, keep);
  }
}

}  // namespace orca::avoid
