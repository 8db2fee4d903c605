// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::detail {

// An opening in a wall.
struct Opening {
  double at = 0.0;     // [m] Distance of its middle from the wall's beginning.
  double width = 0.0;  // [m]
};

// A straight wall with openings.
struct WallPlan {
  std::string name;
  Vec2 from, to;  // Ends of the centre line.
  double thickness = 0.0;
  double height = 0.0;
  std::vector<Opening> openings;
};

// Returns the pieces of a wall between its openings. The outer ends reach half a thickness further, so that
// walls that meet in a point close the corner.
// @errors  invalid_argument: no length; an opening reaches over an end or into another.
[[nodiscard]] Result<std::vector<Obstacle>> pieces_of(WallPlan plan);

}  // namespace orca::sim::detail
