// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::nav {

/// The outline of a robot: a rectangle around its frame's origin whose corners are cut by the circle that holds the robot, or that
/// circle (length and width 0).
///
/// A plain value; its functions may be called from any thread.
struct Footprint {
  double half_length = 0.0;  ///< [m] along x.
  double half_width = 0.0;   ///< [m] along y.
  double radius = 0.0;  ///< [m] of the circle that holds the robot; 0 beside a rectangle: it cuts nothing.

  [[nodiscard]] bool is_circle() const { return half_length <= 0.0 || half_width <= 0.0; }
  /// Returns the radius [m] of the largest circle around the origin within the outline.
  [[nodiscard]] double inner_radius() const;
  /// Returns the radius [m] of the smallest circle around the origin that holds the outline.
  [[nodiscard]] double outer_radius() const;
};

/// Returns the distance [m] from the outline to a point given in the robot's frame: negative or 0 within. It is exact but beside a
/// corner that the circle cuts: there it is the larger of the distances of rectangle and circle, which is never more than the exact one.
/// @thread  pure function, as all of this file; any thread.
[[nodiscard]] double clearance(const Footprint& footprint, Vec2 point);

/// Returns the least clearance() of points given in the frame of `pose`; `most` if all are farther than that.
[[nodiscard]] double clearance(const Footprint& footprint, const Pose2& pose, std::span<const Vec2> points,
                               double most);

/// The free part of a short motion.
struct Room {
  double share = 1.0;      ///< [1] of the motion before the outline comes nearer to a point than the margin.
  double clearance = 0.0;  ///< [m] least distance of outline and points on that part; at most 1 m.
};

/// Returns how much of a motion is free, looked at in `steps` equal steps: the outline at the end of each is exact, and so is
/// their number. Where the outline is nearer than the margin at the start, a motion is free as long as it leads no nearer.
/// @param travel  from `pose`, along an arc.
/// @pre  steps > 0.
[[nodiscard]] Room room_along(const Footprint& footprint, const Pose2& pose, const Travel2& travel, int steps,
                              std::span<const Vec2> points, double margin);

}  // namespace orca::nav
