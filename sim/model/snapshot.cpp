// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/snapshot.hpp"

namespace orca::sim {
namespace {

constexpr double kDrawnHeight = 0.3;  // [m] About the height of sensors.

// Returns the edges to draw. A mesh is drawn as its section at kDrawnHeight, or half way up if it does not
// reach across that height.
std::vector<Segment> drawn_edges(const Obstacle& o) {
  if (o.mesh == nullptr) return edges_of(o.shape);
  const bool reaches = o.bottom <= kDrawnHeight && kDrawnHeight < o.height;
  return section_of(*o.mesh, reaches ? kDrawnHeight : 0.5 * (o.bottom + o.height)).edges;
}

}  // namespace

Snapshot snapshot_of(const WorldModel& world) {
  Snapshot snapshot;
  snapshot.name = world.name;
  snapshot.bounds = world.bounds();
  snapshot.places = world.places;
  for (const Obstacle& o : world.obstacles) {
    if (const auto* circle = std::get_if<Circle>(&o.shape)) snapshot.circles.push_back(*circle);
    const std::vector<Segment> edges = drawn_edges(o);
    snapshot.edges.insert(snapshot.edges.end(), edges.begin(), edges.end());
  }
  return snapshot;
}

}  // namespace orca::sim
