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

}  // namespace orca::hw::sick_lms
