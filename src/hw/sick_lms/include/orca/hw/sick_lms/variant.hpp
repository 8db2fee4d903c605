// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "orca/base/time.hpp"

namespace orca::hw::sick_lms {

/// The beams of a laser: over which angle, and how close to each other. The first beam is the right-most one, at minus
/// half the angle; angles grow counter-clockwise, seen from above.
///
/// A plain value, in the units of the telegrams.
struct Variant {
  unsigned angle = 180;      ///< [deg] 100 or 180.
  unsigned resolution = 50;  ///< [1/100 deg] 25 (with 100 deg only), 50 or 100.
  friend bool operator==(const Variant&, const Variant&) = default;
};

/// All variants that an LMS has.
inline constexpr std::array<Variant, 5> kVariants = {
    {{100, 25}, {100, 50}, {100, 100}, {180, 50}, {180, 100}}};

/// Returns whether it is one of kVariants.
[[nodiscard]] bool is_possible(const Variant& variant);

/// Returns the number of beams.
/// @pre  variant.resolution > 0
[[nodiscard]] std::size_t beams(const Variant& variant);

/// Returns the angle between two beams [rad].
[[nodiscard]] double increment(const Variant& variant);

/// Returns the direction of a beam [rad], 0 ahead, positive to the left.
/// @param beam  Counted from 0, the right-most one.
[[nodiscard]] double beam_angle(const Variant& variant, std::size_t beam);

/// Returns the size of the telegram of a scan (B0) without indices [bytes].
[[nodiscard]] std::size_t scan_size(std::size_t beams);

/// Returns how long bytes take on the line. A driver that stamps the last byte of a scan subtracts this to have the time
/// of its first one.
/// @pre  baud > 0
[[nodiscard]] Duration line_time(std::size_t bytes, unsigned baud);

/// Returns how long the mirror takes to measure all beams of a scan: it turns 75 times a second, and beams that are less than
/// a degree apart need several turns. They were measured that long before the scan is sent.
/// @pre  variant.resolution > 0
[[nodiscard]] Duration mirror_time(const Variant& variant);

/// Returns the shortest time between two scans, which is the longer one of what the mirror and the line need.
[[nodiscard]] Duration scan_period(const Variant& variant, unsigned baud);

}  // namespace orca::hw::sick_lms
