// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"

namespace orca::nav {

/// A piece of the way of a robot that steers: an arc or a straight line.
struct WayPiece {
  double length = 0.0;     ///< [m] negative: backwards.
  double curvature = 0.0;  ///< [1/m] of the line, positive to the robot's left.
};

/// Returns the pose after `length` [m] of a piece, counted as the piece counts it.
[[nodiscard]] Pose2 driven(const Pose2& from, const WayPiece& piece, double length);

/// Returns how far [m] the pieces lead, forwards and backwards.
[[nodiscard]] double length_of(std::span<const WayPiece> way);

/// Returns the shortest way from one pose to another without obstacles, of a robot that drives forwards and backwards and turns in no smaller
/// circle than that of `radius` [m].
/// @pre  radius > 0.
/// @return pieces with curvature 0 or +-1 / radius, at most five of them.
/// @source  Reeds and Shepp, "Optimal paths for a car that goes both forwards and backwards", Pacific Journal of Mathematics 145, 1990, formulas
///          8.1 to 8.11, each in all its mirrored and reversed forms.
/// @thread  pure function, as all of this file; any thread.
[[nodiscard]] std::vector<WayPiece> shortest_way(const Pose2& from, const Pose2& to, double radius);

}  // namespace orca::nav
