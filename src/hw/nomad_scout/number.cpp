// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/number.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orca::hw::nomad_scout {
namespace {

constexpr std::uint32_t kSign16 = 0x8000;
constexpr std::uint32_t kSign32 = 0x80000000;
constexpr double kTenthOfDegree = std::numbers::pi / 1800.0;

int whole(double value) {
  return std::isfinite(value) ? static_cast<int>(std::lround(std::clamp(value, -32767.0, 32767.0))) : 0;
}

}  // namespace

int from_sign_and_magnitude(std::uint16_t bits) {
  const int magnitude = bits & (kSign16 - 1);
  return (bits & kSign16) != 0 ? -magnitude : magnitude;
}

std::uint16_t sign_and_magnitude(int value) {
  const int limited = std::clamp(value, -32767, 32767);
  return static_cast<std::uint16_t>(limited < 0 ? kSign16 + static_cast<unsigned>(-limited)
                                                : static_cast<unsigned>(limited));
}

std::int32_t from_long_sign_and_magnitude(std::uint32_t bits) {
  const auto magnitude = static_cast<std::int32_t>(bits & (kSign32 - 1));
  return (bits & kSign32) != 0 ? -magnitude : magnitude;
}

std::uint32_t long_sign_and_magnitude(std::int64_t value) {
  constexpr std::int64_t kMost = 0x7FFFFFFF;
  const std::int64_t limited = std::clamp(value, -kMost, kMost);
  return limited < 0 ? kSign32 + static_cast<std::uint32_t>(-limited) : static_cast<std::uint32_t>(limited);
}

int in_tenths_of_inch(double value) { return whole(value / kLengthUnit); }
int in_tenths_of_degree(double angle) { return whole(angle / kTenthOfDegree); }
double radians(int tenths_of_degree) { return tenths_of_degree * kTenthOfDegree; }

}  // namespace orca::hw::nomad_scout
