// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "model/walls.hpp"
#include "orca/base/random.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/sim/generate.hpp"
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

// Draw one world of a family, even if there is no way through it.
[[nodiscard]] WorldModel draw(const BarnField& family, RandomStream& random);
[[nodiscard]] WorldModel draw(const UTrap& family, RandomStream& random);
[[nodiscard]] WorldModel draw(const NarrowDoors& family, RandomStream& random);
[[nodiscard]] WorldModel draw(const Corridor& family, RandomStream& random);
[[nodiscard]] WorldModel draw(const OfficeFloor& family, RandomStream& random);

// Return the reason why no world can have these values; empty if one can. `radius` [m] is that of the robot
// that has to get through.
[[nodiscard]] std::string fault_of(const BarnField& family, double radius);
[[nodiscard]] std::string fault_of(const UTrap& family, double radius);
[[nodiscard]] std::string fault_of(const NarrowDoors& family, double radius);
[[nodiscard]] std::string fault_of(const Corridor& family, double radius);
[[nodiscard]] std::string fault_of(const OfficeFloor& family, double radius);

// Draws a whole number in [low, high].
[[nodiscard]] std::size_t pick(RandomStream& random, std::size_t low, std::size_t high);

// Returns "door is 0.4 m; a robot of radius 0.3 m needs more than 0.65 m", or empty if it is wide enough.
[[nodiscard]] std::string too_narrow(const std::string& what, double width, double radius);

}  // namespace orca::sim::detail
