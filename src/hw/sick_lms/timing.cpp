// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/timing.hpp"

#include <algorithm>

namespace orca::hw::sick_lms {

std::size_t scan_size(std::size_t beams) {
  constexpr std::size_t kAround = 10;  // header, code, count word, status, check word
  return kAround + 2 * beams;
}

Duration line_time(std::size_t bytes, unsigned baud, bool has_parity) {
  const auto bits = static_cast<Duration::rep>(bytes) * (has_parity ? 11 : 10);
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
