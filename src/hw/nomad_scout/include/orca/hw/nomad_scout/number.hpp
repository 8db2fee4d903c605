// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace orca::hw::nomad_scout {

/// Signed numbers of the protocol have a sign bit and a magnitude; they are not in two's complement. A negative zero
/// is 0. What does not fit is limited to the largest magnitude.
[[nodiscard]] int from_sign_and_magnitude(std::uint16_t bits);
[[nodiscard]] std::uint16_t sign_and_magnitude(int value);

/// The same with 32 bits.
[[nodiscard]] std::int32_t from_long_sign_and_magnitude(std::uint32_t bits);
[[nodiscard]] std::uint32_t long_sign_and_magnitude(std::int64_t value);

inline constexpr double kLengthUnit =
    0.00254;  ///< [m] a tenth of an inch: lengths, speeds and accelerations.

/// Returns a length, speed or acceleration in the protocol's unit, rounded; 0 if it is not finite.
/// @param value  in metres, and seconds.
[[nodiscard]] int in_tenths_of_inch(double value);

/// Returns an angle in tenths of a degree, rounded; 0 if it is not finite.
/// @param angle [rad]
[[nodiscard]] int in_tenths_of_degree(double angle);

/// Returns tenths of a degree as an angle [rad].
[[nodiscard]] double radians(int tenths_of_degree);

}  // namespace orca::hw::nomad_scout
