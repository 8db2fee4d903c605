// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::hw::nomad_scout {

inline constexpr std::size_t kSonars = 16;

/// Distance between the wheels [m] that follows from the manufacturer's macros. A public program uses 0.3404.
inline constexpr double kTrack = 0.3452;

/// Distance of the sonars from the middle of the robot [m]. It is in no document; measure yours.
inline constexpr double kSonarRadius = 0.2;

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
/// @param radius [m]
[[nodiscard]] Pose2 sonar_pose(std::size_t number, double radius = kSonarRadius);

}  // namespace orca::hw::nomad_scout
