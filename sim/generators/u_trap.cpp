// SPDX-License-Identifier: LGPL-3.0-or-later
#include "families.hpp"
#include "plan.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kApart = 3.0;     // [m] From the trap to start and goal.
constexpr double kMargin = 1.0;    // [m] From start and goal to the hall's ends.
constexpr double kLargest = 50.0;  // [m]

}  // namespace

WorldModel draw(const UTrap& family, RandomStream& random) {
  const double width = family.width * random.uniform(0.8, 1.2);
  const double depth = family.depth * random.uniform(0.8, 1.2);
  const double mouth = kMargin + kApart;
  const double half = 0.5 * (width + kThickness);  // To the middle of the U's arms.
  const double hall = width + 2.0 * (kThickness + family.beside);
  const double y = 0.5 * hall;
  const double bottom = mouth + depth + 0.5 * kThickness;
  WorldModel world;
  add_hall(world, {0.0, 0.0}, {bottom + kApart + kMargin, hall});
  add_wall(world, {mouth, y - half}, {bottom, y - half});
  add_wall(world, {mouth, y + half}, {bottom, y + half});
  add_wall(world, {bottom, y - half}, {bottom, y + half});
  const double across = 0.25 * width;
  const double start = y + random.uniform(-across, across);
  const double goal = y + random.uniform(-across, across);
  world.places = {{"start", {kMargin, start, 0.0}}, {"goal", {bottom + kApart, goal, 0.0}}};
  return world;
}

std::string fault_of(const UTrap& family, double radius) {
  for (const double value : {family.width, family.depth, family.beside})
    if (!(value > 0.0 && value <= kLargest))
      return "width, depth and beside must be more than 0 and at most 50 m";
  return too_narrow("beside", family.beside, radius);
}

}  // namespace orca::sim::detail
