// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/world_model.hpp"

#include <algorithm>
#include <utility>

namespace orca::sim {

Obstacle mesh_obstacle(std::string name, Mesh mesh) {
  const auto [low, high] = height_range_of(mesh);
  const Outline plan = plan_of(mesh);
  return {std::move(name), plan, high, low, std::make_shared<const Mesh>(std::move(mesh))};
}

bool overlap(const Obstacle& o, const Shape& plan, double bottom, double top) {
  if (o.height <= bottom || o.bottom >= top || !overlap(plan, o.shape)) return false;
  return o.mesh == nullptr || overlap(*o.mesh, plan, bottom, top);
}

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
  const auto hit = [&](const Obstacle& o) { return overlap(o, body, bottom, top); };
  const auto found = std::ranges::find_if(obstacles, hit);
  return found == obstacles.end() ? nullptr : &*found;
}

}  // namespace orca::sim
