// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/mesh.hpp"
#include "orca/sim/walker.hpp"

namespace orca::sim {

/// Something solid that never moves: an upright body over its plan.
struct Obstacle {
  std::string name;     ///< For people, e.g. "wall" or "desk_2"; need not be unique.
  Shape shape;          ///< Its plan, in the world frame.
  double height = 0.0;  ///< [m] Its top above the floor; a sensor as high or higher does not see it.
  double bottom = 0.0;  ///< [m] Its underside above the floor, e.g. of a table top; 0: it stands on it.
  /// If it is a mesh, in the world frame: then `shape` is its convex hull seen from above, `bottom` and
  /// `height` hold it, and only what the mesh says is solid. Shared, because models are copied and meshes are
  /// large.
  std::shared_ptr<const Mesh> mesh{};
};

/// An obstacle of a mesh that is in its place already. @pre  the mesh has triangles.
[[nodiscard]] Obstacle mesh_obstacle(std::string name, Mesh mesh);

/// True if the obstacle shares a point with the upright body over `plan` between `bottom` and `top` [m].
[[nodiscard]] bool overlap(const Obstacle& obstacle, const Shape& plan, double bottom, double top);

/// A named pose, e.g. where a robot starts or is to go.
struct Place {
  std::string name;
  Pose2 pose;
};

/// A world without robots: a plan with heights (2.5-D), named places, and people who walk about. A plain
/// value.
struct WorldModel {
  std::string name;
  std::vector<Obstacle> obstacles;
  std::vector<Place> places;
  std::vector<Walker> walkers{};

  /// The place of that name, or null.
  [[nodiscard]] const Place* place(std::string_view name) const;

  /// The rectangle that holds all obstacles and places.
  [[nodiscard]] Bounds bounds() const;

  /// The first obstacle that shares a point with the upright body over `body` between `bottom` and `top` [m],
  /// or null.
  [[nodiscard]] const Obstacle* obstacle_at(const Shape& body, double bottom,
                                            double top = std::numeric_limits<double>::infinity()) const;
};

}  // namespace orca::sim
