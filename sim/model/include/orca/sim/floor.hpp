// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/sim/shape.hpp"

namespace orca::sim {

/// A part of the floor on which wheels slip more than elsewhere. It acts on a robot while the middle of its wheels is there.
struct WetPatch {
  std::string name;
  Outline area;       ///< In the world frame.
  double slip = 4.0;  ///< Factor on the standard deviation of the wheels' slip, at least 1.
  double grip = 0.5;  ///< Share of the force that wheels can take on a dry floor, 0 to 1.
};

/// A low step to drive over, such as the sill of a door. A wheel that crosses it climbs up and down: it rolls farther than it
/// gets ahead, and its encoder does not know.
struct Sill {
  std::string name;
  Segment line;         ///< In the world frame.
  double height = 0.0;  ///< [m]
};

/// What makes wheels go another way than they roll, depending on the place. It acts at all levels of realism.
struct Floor {
  std::vector<WetPatch> patches;
  std::vector<Sill> sills;

  /// Returns the factor on slip at a point, the largest of the patches there; 1 outside of all.
  [[nodiscard]] double slip_at(Vec2 point) const;
  /// Returns the share of grip at a point, the least of the patches there; 1 outside of all.
  [[nodiscard]] double grip_at(Vec2 point) const;
  /// Returns by how much a wheel [m] of that diameter that moves along `way` falls behind what it rolls, on all sills it crosses.
  [[nodiscard]] double way_lost(const Segment& way, double wheel_diameter) const;
};

/// Returns by how much a wheel [m] that climbs over a thin edge gets less far than it rolls: its hub moves on two arcs about
/// the edge, of the angle acos(1 - h / r) each. Half its radius is the most that a wheel climbs.
/// @param diameter, height  [m] > 0.
[[nodiscard]] double way_lost_on_edge(double diameter, double height);

}  // namespace orca::sim
