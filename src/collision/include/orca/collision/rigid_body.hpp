// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <vector>

namespace orca::collision {

/// Three corners [m] of a flat piece of a surface.
using Facet = std::array<Eigen::Vector3d, 3>;

/// A body of convex solids and of surfaces in space, all in the frame of the body. FCL finds whether two share a point.
///
/// Solids are smaller by kTouch on each side, so bodies that only touch do not meet. A surface has no inside: it does not meet what
/// stands within it and touches it nowhere.
///
/// Thread contract: not synchronised while solids are added; afterwards its functions may be called from several threads.
class RigidBody {
 public:
  static constexpr double kTouch = 1e-4;  ///< [m]

  RigidBody();
  ~RigidBody();
  RigidBody(RigidBody&&) noexcept;
  RigidBody& operator=(RigidBody&&) noexcept;

  /// Adds a block. @param lengths  [m] along its own axes.
  void add_block(const Eigen::Isometry3d& X_BS, const Eigen::Vector3d& lengths);
  /// Adds a cylinder along its own z axis, with its middle in the origin. @param radius, length  [m]
  void add_cylinder(const Eigen::Isometry3d& X_BS, double radius, double length);
  /// Adds a ball. @param middle, radius  [m]
  void add_ball(const Eigen::Vector3d& middle, double radius);
  /// Adds the convex hull of points. @param corners  [m] in the frame of the body, at least four that are not in one plane.
  void add_hull(std::vector<Eigen::Vector3d> corners);
  /// Adds a surface; nothing if it has no facet.
  void add_surface(const std::vector<Facet>& facets);

  /// Returns whether the two share a point. @param X_BO  pose of the other in the frame of this one.
  [[nodiscard]] bool meets(const RigidBody& other, const Eigen::Isometry3d& X_BO) const;

 private:
  struct Pieces;
  std::unique_ptr<Pieces> pieces_;
};

}  // namespace orca::collision
