// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/floor.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::sim {

double Floor::slip_at(Vec2 point) const {
  double slip = 1.0;
  for (const WetPatch& patch : patches)
    if (contains(Shape(patch.area), point)) slip = std::max(slip, patch.slip);
  return slip;
}

double Floor::grip_at(Vec2 point) const {
  double grip = 1.0;
  for (const WetPatch& patch : patches)
    if (contains(Shape(patch.area), point)) grip = std::min(grip, patch.grip);
  return grip;
}

double Floor::way_lost(const Segment& way, double wheel_diameter) const {
  double lost = 0.0;
  for (const Sill& sill : sills)
    if (cross_each_other(way, sill.line)) lost += way_lost_on_edge(wheel_diameter, sill.height);
  return lost;
}

double way_lost_on_edge(double diameter, double height) {
  const double radius = 0.5 * diameter;
  const double angle = portable::acos(1.0 - std::min(height / radius, 0.5));
  return 2.0 * radius * (angle - portable::sin(angle));
}

}  // namespace orca::sim
