// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/scene.hpp"

namespace orca::sim {

Scene scene_of(const WorldModel& world) {
  Scene scene;
  scene.name = world.name;
  scene.bounds = world.bounds();
  scene.places = world.places;
  for (const Obstacle& o : world.obstacles) {
    if (const auto* circle = std::get_if<Circle>(&o.shape)) scene.circles.push_back(*circle);
    const std::vector<Segment> edges = edges_of(o.shape);
    scene.edges.insert(scene.edges.end(), edges.begin(), edges.end());
  }
  return scene;
}

}  // namespace orca::sim
