// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

namespace orca::hw::sick_lms {

/// The unit of distances, as scans and the configuration name it.
enum class Unit : std::uint8_t { centimetre = 0, millimetre = 1, decimetre = 2 };

/// Returns the unit in metres.
[[nodiscard]] double metres(Unit unit);

/// The layout of the 16 bits of a value. A measuring mode is the byte in the configuration.
///
/// A plain value.
struct ValueLayout {
  std::uint16_t distance_mask = 0;  ///< Bits of the distance, from bit 0; 0: the value is a reflectivity.
  bool has_reflector_level =
      false;  ///< The bits above are the level of a reflector; otherwise a bit per field.

  [[nodiscard]] bool is_distance() const { return distance_mask != 0; }
  /// Returns whether a distance is one of the codes for no echo, dazzling, too weak or too far.
  [[nodiscard]] bool is_no_return(std::uint16_t distance) const;
  /// Returns the bits above the distance, from bit 0.
  [[nodiscard]] std::uint8_t flags(std::uint16_t value) const;
};

/// Returns the layout of a measuring mode; nothing if the mode is unknown.
/// @source  LMS2xx telegram listing, "Measuring mode" of the configuration, and "Error codes" of measured values.
[[nodiscard]] std::optional<ValueLayout> layout_of(std::uint8_t measuring_mode);

}  // namespace orca::hw::sick_lms
