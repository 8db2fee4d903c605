// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

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

}  // namespace orca::hw::sick_lms
