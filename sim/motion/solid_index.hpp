// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "orca/sim/mesh.hpp"
#include "orca/sim/world_model.hpp"
#include "rounded.hpp"

namespace orca::sim::detail {

// A convex piece of an obstacle, in the world's frame, with the heights between which it stands.
struct Solid {
  Rounded plan;
  double bottom = 0.0, top = 0.0;  // [m]
  std::size_t obstacle = 0;        // Number in the world's model.
  // The triangle of a mesh. Its plan between two heights depends on these; `plan` is the plan of the whole.
  const Triangle* triangle = nullptr;
};

// Returns the plan of what a piece has between two heights; no corners if it has nothing there.
[[nodiscard]] Rounded plan_between(const Solid& solid, double low, double high);

// Returns the smallest upright box around an area, as Bullet's tree takes it.
[[nodiscard]] btDbvtVolume volume_of(const Bounds& area);

// What stands in a world, in Bullet's tree of bounding boxes: a look at some place costs the logarithm of what
// stands in the world, wherever that is, and nothing while nobody looks.
class SolidIndex {
 public:
  // @param world  outlives the index, whose triangles are those of its meshes.
  explicit SolidIndex(const WorldModel& world);
  SolidIndex(const SolidIndex&) = delete;
  SolidIndex& operator=(const SolidIndex&) = delete;

  // Calls `visit` for each piece whose bounding box meets the area, always in the same order.
  void visit(const Bounds& area, const std::function<void(const Solid&)>& visit);

 private:
  void add(Solid solid);

  std::vector<Solid> solids_;
  btDbvt tree_;
};

}  // namespace orca::sim::detail
