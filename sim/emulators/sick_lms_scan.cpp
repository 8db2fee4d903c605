// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sick_lms_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace orca::emulators {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr unsigned kFarthest = 8;  // below the mask begin the codes for what is no distance

double metres_of(std::uint8_t unit) { return unit == 0 ? 0.01 : unit == 1 ? 0.001 : 0.1; }

double range_at(const MirrorTurn& turn, double angle) {
  const double index = std::round((angle - turn.first_angle) / turn.step);
  if (!(index >= 0.0 && index < static_cast<double>(turn.ranges.size())))
    return std::numeric_limits<double>::infinity();
  return turn.ranges[static_cast<std::size_t>(index)];
}

unsigned value_of(double range, unsigned mask, double unit) {
  if (!std::isfinite(range)) return mask;  // no echo
  const double counts = std::round(range / unit);
  return counts < mask - kFarthest ? static_cast<unsigned>(std::max(counts, 0.0)) : mask - kFarthest;
}

}  // namespace

unsigned distance_mask(std::uint8_t measuring_mode) {
  switch (measuring_mode) {
    case 0:
    case 1:
    case 2: return 0x1FFF;
    case 3:
    case 4: return 0x3FFF;
    case 5:
    case 6: return 0x7FFF;
    case 0x0F: return 0xFFFF;
    default: return 0;
  }
}

void add_values(std::vector<std::uint8_t>& payload, const MirrorTurn& turn, const LmsBeams& beams,
                LmsValues values) {
  const unsigned mask = distance_mask(values.measuring_mode);
  const double unit = metres_of(values.unit);
  append_u16(payload, (beams.last - beams.first + 1) | static_cast<unsigned>(values.unit << 14));
  for (unsigned beam = beams.first; beam <= beams.last; ++beam) {
    const double degrees = (beam - 1) * beams.resolution / 100.0 - beams.angle / 2.0;
    append_u16(payload, value_of(range_at(turn, degrees * kDegree), mask, unit));
  }
}

void append_u16(std::vector<std::uint8_t>& payload, unsigned value) {
  payload.push_back(static_cast<std::uint8_t>(value & 0xFF));
  payload.push_back(static_cast<std::uint8_t>((value >> 8) & 0xFF));
}

}  // namespace orca::emulators
