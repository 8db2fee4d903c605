// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/scan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "orca/base/portable_math.hpp"

namespace orca::avoid {
namespace {

constexpr double kBehind = 0.02;  // [m] An echo that much behind a reading is another one, hidden by it.

// Returns where a beam ends; nothing if it met nothing.
std::optional<Vec2> place_of(const Scan& scan, std::size_t i) {
  const double yaw = scan.X_RS.yaw + scan.angle_start + scan.angle_increment * static_cast<double>(i);
  return echo_of(scan.ranges[i], scan.min_range, scan.max_range, {scan.X_RS.x, scan.X_RS.y, yaw});
}

double distance(Vec2 echo) { return portable::hypot(echo.x, echo.y); }

// Returns whether the beam to a place has measured nothing. `along` is its angle from the first beam.
bool is_unread(const Scan& scan, double along) {
  if (scan.angle_increment == 0.0) return std::isnan(scan.ranges.front());
  const auto last = static_cast<long>(scan.ranges.size()) - 1;
  const long beam = std::clamp(std::lround(along / scan.angle_increment), 0L, last);
  return std::isnan(scan.ranges[static_cast<std::size_t>(beam)]);
}

// Returns whether a beam beside a place ends before it. `along` is its angle from the first beam.
bool is_hidden(const Scan& scan, double along, double away) {
  if (scan.angle_increment == 0.0) return false;  // no beam is beside another
  const auto last = static_cast<long>(scan.ranges.size()) - 1;
  const long beam = std::lround(along / scan.angle_increment);
  for (long i = std::max(0L, beam - 1); i <= std::min(last, beam + 1); ++i)
    if (scan.ranges[static_cast<std::size_t>(i)] + kBehind < away) return true;
  return false;
}

bool is_replaced(const Scan& scan, Vec2 echo, bool keeps_hidden) {
  const Vec2 seen = seen_from(scan.X_RS, echo);
  const double width = scan.angle_increment * static_cast<double>(scan.ranges.size() - 1);
  const double middle = scan.angle_start + 0.5 * width;
  const double off = wrapped(portable::atan2(seen.y, seen.x) - middle);
  const double away = distance(seen);
  if (away >= scan.max_range || std::abs(off) > 0.5 * std::abs(width)) return false;
  if (is_unread(scan, off + 0.5 * width)) return false;
  return !keeps_hidden || !is_hidden(scan, off + 0.5 * width, away);
}

std::size_t beams_in(double sector, const Scan& scan) {
  const double beams = sector / std::max(std::abs(scan.angle_increment), 1e-9);
  return static_cast<std::size_t>(std::clamp(beams, 1.0, static_cast<double>(scan.ranges.size())));
}

// Returns the reading of those beams that is nearest to the robot's centre.
std::optional<Vec2> nearest_of(const Scan& scan, std::size_t first, std::size_t end) {
  std::optional<Vec2> nearest;
  for (std::size_t i = first; i < std::min(end, scan.ranges.size()); ++i) {
    const std::optional<Vec2> place = place_of(scan, i);
    if (place && (!nearest || distance(*place) < distance(*nearest))) nearest = place;
  }
  return nearest;
}

}  // namespace

void see(const Scan& scan, const Detail& detail, const EchoMemory::Limits& keep, EchoMemory& memory) {
  if (scan.ranges.empty()) return;
  memory.forget_if(keep.sensor, [&](Vec2 echo) { return is_replaced(scan, echo, keep.hidden); });
  const std::size_t step = beams_in(detail.sector, scan);
  const std::size_t fine = beams_in(detail.fine, scan);
  for (std::size_t first = 0; first < scan.ranges.size(); first += step) {
    const std::optional<Vec2> nearest = nearest_of(scan, first, first + step);
    if (!nearest || distance(*nearest) >= detail.range) continue;
    if (distance(*nearest) >= detail.near) {
      memory.hear(*nearest, keep);
      continue;
    }
    for (std::size_t part = first; part < first + step; part += fine)
      if (const auto place = nearest_of(scan, part, std::min(part + fine, first + step));
          place && distance(*place) < detail.range)
        memory.hear(*place, keep);
  }
}

}  // namespace orca::avoid
