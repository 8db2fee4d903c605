// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "model/walls.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::detail {

// The building blocks of generated worlds. Walls are 0.1 m thick; everything but furniture is 2.5 m tall.
inline constexpr double kThickness = 0.1;  // [m]
inline constexpr double kTall = 2.5;       // [m]

// Adds a straight wall, given by its centre line, with openings. @pre  it can be built.
void add_wall(WorldModel& world, Vec2 from, Vec2 to, std::vector<Opening> openings = {});

// Adds four walls around the free rectangle between the corners.
void add_hall(WorldModel& world, Vec2 low, Vec2 high);

// Adds a box parallel to the axes, `height` [m] tall.
void add_block(WorldModel& world, const std::string& name, const Bounds& bounds, double height);

}  // namespace orca::sim::detail
