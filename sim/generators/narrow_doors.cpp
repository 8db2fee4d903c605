// SPDX-License-Identifier: LGPL-3.0-or-later
#include "families.hpp"
#include "plan.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kJamb = 0.3;  // [m] Least wall beside a door.

}  // namespace

WorldModel draw(const NarrowDoors& family, RandomStream& random) {
  WorldModel world;
  const double nearest = kJamb + 0.5 * family.door;
  const double length = static_cast<double>(family.walls + 1) * family.spacing;
  add_hall(world, {0.0, 0.0}, {length, family.width});
  for (std::size_t i = 1; i <= family.walls; ++i) {
    const double x = static_cast<double>(i) * family.spacing;
    const double at = random.uniform(nearest, family.width - nearest);
    add_wall(world, {x, 0.0}, {x, family.width}, {{at, family.door}});
  }
  const double y = 0.5 * family.width;
  world.places = {{"start", {0.5 * family.spacing, y, 0.0}},
                  {"goal", {length - 0.5 * family.spacing, y, 0.0}}};
  return world;
}

std::string fault_of(const NarrowDoors& family, double radius) {
  if (family.walls < 1 || family.walls > 50) return "walls must be between 1 and 50";
  if (!(family.spacing <= 20.0 && family.width <= 50.0))
    return "spacing must be at most 20 m, width at most 50 m";
  if (!(family.width >= family.door + 2.0 * kJamb))
    return "the hall's width must be that of a door and 0.6 m more";
  if (const std::string fault = too_narrow("spacing", family.spacing - kThickness, radius); !fault.empty())
    return fault;
  return too_narrow("door", family.door, radius);
}

}  // namespace orca::sim::detail
