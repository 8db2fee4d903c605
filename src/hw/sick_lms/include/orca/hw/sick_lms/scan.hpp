// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/hw/sick_lms/reply.hpp"

namespace orca::hw::sick_lms {

/// What a scan does not say of itself: settings of the laser that sends it.
struct ScanFormat {
  std::uint8_t measuring_mode = 0;   ///< Of the configuration.
  bool has_real_time_index = false;  ///< Bit 1 of the availability in the configuration.
  bool has_telegram_index = false;   ///< The laser numbers its telegrams.
};

/// A scan, or a part of one.
///
/// A plain value. One that is used again takes no memory for a scan that is not longer than those before.
struct Scan {
  std::size_t first_beam = 0;  ///< Of `ranges`, counted from 0 at the right.
  std::optional<unsigned>
      quarter{};  ///< Of a partial scan: by how many quarters of a degree its beams lie further to the left.
  std::vector<double>
      ranges;  ///< [m] to the left, one per beam; infinite: no return. Empty: reflectivity alone.
  std::vector<std::uint8_t>
      flags;  ///< The bits above each distance: see ValueLayout::flags(). Empty: there are none.
  std::vector<std::uint16_t> reflectivity;        ///< One per beam; empty: not sent.
  std::optional<std::uint8_t> real_time_index{};  ///< Counts turns of the mirror.
  std::optional<std::uint8_t> telegram_index{};   ///< Counts telegrams.
  StatusByte status{};
};

/// Reads a reply with the code B0, B7 or F5.
/// @param scan  Is replaced; after an error its content is of no use.
/// @errors  invalid_argument for a reply that is no scan; unimplemented for an unknown measuring mode or several parts in
///          one telegram; data_loss if it is shorter than it says.
[[nodiscard]] Status parse_scan(const Reply& reply, const ScanFormat& format, Scan& scan);

/// Returns the direction of the i-th range of a scan [rad], 0 ahead, positive to the left. The beams of a partial scan are 1 degree
/// apart.
/// @param variant  That the laser has now.
[[nodiscard]] double angle_of(const Scan& scan, std::size_t i, const Variant& variant);

}  // namespace orca::hw::sick_lms
