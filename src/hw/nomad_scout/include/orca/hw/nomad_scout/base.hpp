// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::hw::nomad_scout {

inline constexpr std::size_t kSonars = 16;

/// Distance between the wheels [m] that follows from the manufacturer's macros. A public program uses 0.3404.
inline constexpr double kTrack = 0.3452;

/// A quantity per wheel, forward positive, in SI units. On the line the right wheel comes first.
///
/// A plain value.
struct Wheels {
  double left = 0.0;
  double right = 0.0;
  friend bool operator==(const Wheels&, const Wheels&) = default;
};

/// Returns the speeds of the wheels [m/s] for a twist; its `left` is ignored, since a Scout cannot move sideways.
/// @param track [m]
[[nodiscard]] Wheels wheels_of(const Twist2& twist, double track = kTrack);

/// Returns the twist for speeds of the wheels [m/s].
/// @param track [m]  > 0
[[nodiscard]] Twist2 twist_of(const Wheels& speeds, double track = kTrack);

/// Returns the pose of a sonar in the robot frame; its x axis is the axis of the cone. Number 0 looks ahead, the others follow
/// counter-clockwise, 22.5 degrees apart.
/// @param radius [m]  of the ring that they sit in.
[[nodiscard]] Pose2 sonar_pose(std::size_t number, double radius);

/// Signed numbers of the protocol have a sign bit and a magnitude; they are not in two's complement. A negative zero
/// is 0. What does not fit is limited to the largest magnitude.
[[nodiscard]] int from_sign_and_magnitude(std::uint16_t bits);
[[nodiscard]] std::uint16_t sign_and_magnitude(int value);

inline constexpr double kLengthUnit =
    0.00254;  ///< [m] a tenth of an inch: lengths, speeds and accelerations.

/// Returns a length, speed or acceleration in the protocol's unit, rounded; 0 if it is not finite.
/// @param value  in metres, and seconds.
[[nodiscard]] int in_tenths_of_inch(double value);

/// Returns tenths of a degree as an angle [rad].
[[nodiscard]] double radians(int tenths_of_degree);

}  // namespace orca::hw::nomad_scout
