// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/navigation/footprint.hpp"
#include "orca/navigation/occupancy_map.hpp"
#include "orca/navigation/path.hpp"

namespace orca::nav {

/// A narrow place between two obstacles.
struct Gap {
  Vec2 middle;         ///< map frame.
  Vec2 axis;           ///< unit vector through it.
  double width = 0.0;  ///< [m]
};

/// Returns the gap that a place lies in: between the nearest obstacle and the nearest one on the other side, as seen from the
/// middle between them.
/// @param heading  the axis points to its side.
/// @param reach [m]  obstacles farther from the place do not count.
/// @return nothing if there are no obstacles on both sides.
/// @thread  pure function, as all of this file; any thread.
[[nodiscard]] std::optional<Gap> gap_around(const OccupancyMap& map, Vec2 place, Vec2 heading, double reach);

/// Makes a path go straight through the middle of each gap in which the robot could not turn round, as far before and behind it as
/// there is room, so that a long robot has lined up when it gets there.
[[nodiscard]] Path lined_up(const OccupancyMap& map, const Footprint& footprint, const Path& path);

}  // namespace orca::nav
