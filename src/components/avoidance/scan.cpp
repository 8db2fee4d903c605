// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/scan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "orca/base/portable_math.hpp"

namespace orca::avoid {
namespace {

// Returns where a beam ends; nothing if it met nothing.
std::optional<Vec2> place_of(const Scan& scan, std::size_t i) {
  const double yaw = scan.X_RS.yaw + scan.angle_start + scan.angle_increment * static_cast<double>(i);
  return echo_of(scan.ranges[i], scan.min_range, scan.max_range, {scan.X_RS.x, scan.X_RS.y, yaw});
}

double distance(Vec2 echo) { return portable::hypot(echo.x, echo.y); }

bool in_view(const Scan& scan, Vec2 echo) {
  const Vec2 seen = seen_from(scan.X_RS, echo);
  const double width = scan.angle_increment * static_cast<double>(scan.ranges.size() - 1);
  const double middle = scan.angle_start + 0.5 * width;
  const double off = wrapped(portable::atan2(seen.y, seen.x) - middle);
  return distance(seen) < scan.max_range && std::abs(off) <= 0.5 * std::abs(width);
}

}  // namespace

void see(const Scan& scan, double sector, double range, const EchoMemory::Limits& keep, EchoMemory& memory) {
  if (scan.ranges.empty()) return;
  memory.forget_if([&](Vec2 echo) { return in_view(scan, echo); });
  const double beams = sector / std::max(std::abs(scan.angle_increment), 1e-9);
  const auto step = static_cast<std::size_t>(std::clamp(beams, 1.0, static_cast<double>(scan.ranges.size())));
  for (std::size_t first = 0; first < scan.ranges.size(); first += step) {
    std::optional<Vec2> nearest;
    for (std::size_t i = first; i < std::min(first + step, scan.ranges.size()); ++i) {
      const std::optional<Vec2> place = place_of(scan, i);
      if (place && (!nearest || distance(*place) < distance(*nearest))) nearest = place;
    }
    if (nearest && distance(*nearest) < range) memory.hear(*nearest, keep);
  }
}

}  // namespace orca::avoid
