// SPDX-License-Identifier: LGPL-3.0-or-later
#include "plan.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace orca::sim::detail {

void add_wall(WorldModel& world, Vec2 from, Vec2 to, std::vector<Opening> openings) {
  auto pieces = pieces_of({"wall", from, to, kThickness, kTall, std::move(openings)});
  std::ranges::move(pieces.value(), std::back_inserter(world.obstacles));
}

void add_hall(WorldModel& world, Vec2 low, Vec2 high) {
  const double half = 0.5 * kThickness;
  const Vec2 a{low.x - half, low.y - half};
  const Vec2 b{high.x + half, high.y + half};
  add_wall(world, a, {b.x, a.y});
  add_wall(world, {a.x, b.y}, b);
  add_wall(world, a, {a.x, b.y});
  add_wall(world, {b.x, a.y}, b);
}

void add_block(WorldModel& world, const std::string& name, const Bounds& bounds, double height) {
  const Vec2 middle = 0.5 * (bounds.low + bounds.high);
  world.obstacles.push_back({name, Box{{middle.x, middle.y, 0.0}, 0.5 * (bounds.high - bounds.low)}, height});
}

}  // namespace orca::sim::detail
