// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/navigation/known_map.hpp"

namespace orca::explore {

/// A border between what is known to be free and what is not known, as far as the robot can go there.
struct Frontier {
  Vec2 place;          ///< map frame: that of its cells that is nearest to their middle.
  double width = 0.0;  ///< [m] number of its cells, as a length.
  double way = 0.0;    ///< [m] from the robot to there, around obstacles, over cells that are known.
};

/// Returns the frontiers that a robot can reach, the nearest first. The robot's own cell counts as one where it can be.
/// @param clearance [m]  least distance of the robot's middle from occupied cells.
/// @param robot  map frame.
/// @param least [m]  narrower ones are left out: behind them there is no room for it.
/// @thread  pure function; any thread.
/// @source  Yamauchi, "A Frontier-Based Approach for Autonomous Exploration", CIRA 1997.
[[nodiscard]] std::vector<Frontier> frontiers(const nav::FloorGrid& map, double clearance, Vec2 robot,
                                              double least);

}  // namespace orca::explore
