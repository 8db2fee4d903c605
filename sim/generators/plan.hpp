// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "model/walls.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::detail {

// What generated worlds are built of. Walls are 0.1 m thick, everything is 2.5 m tall but furniture.
inline constexpr double kThickness = 0.1;  // [m]
inline constexpr double kTall = 2.5;       // [m]

// A straight wall on its centre line, with openings. @pre  it can be built.
void add_wall(WorldModel& world, Vec2 from, Vec2 to, std::vector<Opening> openings = {});

// Four walls around the free rectangle between the corners.
void add_hall(WorldModel& world, Vec2 low, Vec2 high);

// A box parallel to the axes.
void add_block(WorldModel& world, const std::string& name, const Bounds& bounds, double height);

}  // namespace orca::sim::detail
