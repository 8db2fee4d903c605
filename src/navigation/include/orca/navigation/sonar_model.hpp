// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/known_map.hpp"

namespace orca::nav {

/// An echo of a sonar, or that none came.
struct SonarEcho {
  Pose2 X_RS;              ///< The sonar in the robot frame now; its x axis is that of the cone.
  double range = 0.0;      ///< [m]; at max_range or above: no echo.
  double max_range = 0.0;  ///< [m]
  double half_lobe = 0.0;  ///< [rad]
};

/// Returns how likely the echoes are if the robot is at a pose: more than 0, on no certain scale. A smooth wall may give no echo at a slant, or
/// the second one; a person may stand in front of it. An echo that is no number says nothing, here and below.
/// @thread  pure function, as the next; any thread.
[[nodiscard]] double likelihood(std::span<const SonarEcho> echoes, const KnownMap& map, const Pose2& X_MR);

/// Returns the share [1] of the echoes that the map explains. Others count half.
[[nodiscard]] double share_heard(std::span<const SonarEcho> echoes, const KnownMap& map, const Pose2& X_MR);

}  // namespace orca::nav
