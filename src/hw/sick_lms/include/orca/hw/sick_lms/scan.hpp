// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/hw/sick_lms/reply.hpp"

namespace orca::hw::sick_lms {

/// Returns the bits of a value that are its distance, from bit 0, in a measuring mode of the configuration. Nothing if the mode is
/// unknown, or gives no distances.
/// @source  LMS2xx telegram listing, "Measuring mode" of the configuration.
[[nodiscard]] std::optional<std::uint16_t> distance_mask(std::uint8_t measuring_mode);

/// Reads a whole scan: a reply with ReplyCode::scan.
/// @param ranges  Are replaced: [m] to the left, one per beam; infinite: no return. After an error they are of no use. They
///                take no memory for a scan that is not longer than those before.
/// @errors  invalid_argument for a reply that is no scan; unimplemented for a measuring mode without a distance_mask(); data_loss
///          if it is shorter than it says.
/// @source  LMS2xx telegram listing, "Error codes" of measured values.
[[nodiscard]] Status parse_scan(const Reply& reply, std::uint8_t measuring_mode, std::vector<double>& ranges);

}  // namespace orca::hw::sick_lms
