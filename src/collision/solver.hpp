// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "orca/collision/rigid_body.hpp"

namespace fcl {
template <typename S>
class CollisionGeometry;
}

namespace orca::collision {

/// A shape of FCL.
using Geometry = std::shared_ptr<const fcl::CollisionGeometry<double>>;

/// The faces of a hull: how many, and one after the other the number of corners of each and which these are.
struct Faces {
  int count = 0;
  std::vector<int> corners{};
};

/// What this library asks of FCL, which takes a process 10 ms to load.
///
/// Thread contract: immutable; its functions may be called from several threads.
class Solver {
 public:
  virtual ~Solver() = default;
  /// Return shapes around their own middle. @param lengths, radius, length  [m]
  [[nodiscard]] virtual Geometry block(const Eigen::Vector3d& lengths) const = 0;
  [[nodiscard]] virtual Geometry cylinder(double radius, double length) const = 0;
  [[nodiscard]] virtual Geometry ball(double radius) const = 0;
  /// Returns the hull of points [m]. Without faces FCL looks at all points for the farthest in a direction.
  [[nodiscard]] virtual Geometry hull(std::vector<Eigen::Vector3d> points, Faces faces) const = 0;
  [[nodiscard]] virtual Geometry surface(const std::vector<Facet>& facets) const = 0;
  /// Returns whether two shapes share a point.
  [[nodiscard]] virtual bool meet(const Geometry& a, const Eigen::Isometry3d& X_WA, const Geometry& b,
                                  const Eigen::Isometry3d& X_WB) const = 0;
  /// Returns the distance [m] of a shape and a block; 0 or less if they share a point.
  [[nodiscard]] virtual double distance(const Geometry& a, const Eigen::Isometry3d& X_WA,
                                        const Eigen::Vector3d& lengths,
                                        const Eigen::Isometry3d& X_WB) const = 0;
};

/// Returns the solver; the first call in a process loads FCL.
/// @errors  std::runtime_error: FCL cannot be loaded, so Orca is not installed as a whole.
[[nodiscard]] const Solver& solver();

/// The function of liborca_fcl.so.
extern "C" const Solver& orca_fcl_solver();

}  // namespace orca::collision
