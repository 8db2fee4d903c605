// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/scene.hpp"

namespace orca::sim {
namespace {

constexpr double kDrawnHeight = 0.3;  // [m] Where sensors look, of what reaches over it.

// A mesh is drawn as its section there, or half way up.
std::vector<Segment> drawn_edges(const Obstacle& o) {
  if (o.mesh == nullptr) return edges_of(o.shape);
  const bool reaches = o.bottom <= kDrawnHeight && kDrawnHeight < o.height;
  return section_of(*o.mesh, reaches ? kDrawnHeight : 0.5 * (o.bottom + o.height)).edges;
}

}  // namespace

Scene scene_of(const WorldModel& world) {
  Scene scene;
  scene.name = world.name;
  scene.bounds = world.bounds();
  scene.places = world.places;
  for (const Obstacle& o : world.obstacles) {
    if (const auto* circle = std::get_if<Circle>(&o.shape)) scene.circles.push_back(*circle);
    const std::vector<Segment> edges = drawn_edges(o);
    scene.edges.insert(scene.edges.end(), edges.begin(), edges.end());
  }
  return scene;
}

}  // namespace orca::sim
