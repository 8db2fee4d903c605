// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/world_model.hpp"

#include <algorithm>

namespace orca::sim {

const Place* WorldModel::place(std::string_view wanted) const {
  const auto found = std::ranges::find(places, wanted, &Place::name);
  return found == places.end() ? nullptr : &*found;
}

Bounds WorldModel::bounds() const {
  Bounds all;
  for (const Obstacle& o : obstacles) {
    const Bounds b = bounds_of(o.shape);
    all.add(b.low);
    all.add(b.high);
  }
  for (const Place& p : places) all.add(p.pose.position());
  return all;
}

const Obstacle* WorldModel::obstacle_at(const Shape& body, double bottom, double top) const {
  const auto hit = [&](const Obstacle& o) {
    return o.height > bottom && o.bottom < top && overlap(body, o.shape);
  };
  const auto found = std::ranges::find_if(obstacles, hit);
  return found == obstacles.end() ? nullptr : &*found;
}

}  // namespace orca::sim
