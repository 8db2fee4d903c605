// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "orca/base/time.hpp"
#include "orca/hw/sick_lms/variant.hpp"

namespace orca::hw::sick_lms {

/// Returns the size of the telegram of a scan (B0) without indices [bytes].
[[nodiscard]] std::size_t scan_size(std::size_t beams);

/// Returns how long bytes take on the line. A driver that stamps the last byte of a scan subtracts this to have the time
/// of its first one.
/// @pre  baud > 0
/// @param has_parity  A bit more per byte.
[[nodiscard]] Duration line_time(std::size_t bytes, unsigned baud, bool has_parity = false);

/// Returns how long the mirror takes to measure all beams of a scan: it turns 75 times a second, and beams that are less than
/// a degree apart need several turns. They were measured that long before the scan is sent.
/// @pre  variant.resolution > 0
[[nodiscard]] Duration mirror_time(const Variant& variant);

/// Returns the shortest time between two scans, which is the longer one of what the mirror and the line need.
[[nodiscard]] Duration scan_period(const Variant& variant, unsigned baud);

}  // namespace orca::hw::sick_lms
