// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/variant.hpp"

#include <algorithm>
#include <numbers>

namespace orca::hw::sick_lms {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

bool is_possible(const Variant& variant) { return std::ranges::find(kVariants, variant) != kVariants.end(); }

std::size_t beams(const Variant& variant) { return 100 * variant.angle / variant.resolution + 1; }

double increment(const Variant& variant) { return variant.resolution * (kDegree / 100.0); }

double beam_angle(const Variant& variant, std::size_t beam) {
  const double degrees = static_cast<double>(beam) * variant.resolution / 100.0 - variant.angle / 2.0;
  return degrees * kDegree;
}

std::size_t scan_size(std::size_t beams) {
  constexpr std::size_t kAround = 10;  // header, code, count word, status, check word
  return kAround + 2 * beams;
}

Duration line_time(std::size_t bytes, unsigned baud) {
  const auto bits = static_cast<Duration::rep>(bytes) * 10;
  return Duration(bits * 1'000'000'000 / baud);
}

Duration mirror_time(const Variant& variant) {
  constexpr Duration kSecond{1s};
  return kSecond * 100 / (75 * variant.resolution);
}

Duration scan_period(const Variant& variant, unsigned baud) {
  return std::max(mirror_time(variant), line_time(scan_size(beams(variant)), baud));
}

}  // namespace orca::hw::sick_lms
