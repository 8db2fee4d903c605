// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "diagram.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/vec2.hpp"

/// The free walking area of ND+: the region through which the robot goes on to its goal. Terms, frames and threads: see
/// diagram.hpp.
namespace orca::nd {

/// The place to drive to.
struct Goal {
  double direction = 0.0;  ///< [rad]
  double distance = 0.0;   ///< [m] that it must come nearer until the goal is reached.
  /// [rad] in which it went in the lap before, if it went past an edge: of gaps that are about as near to the goal it keeps that one.
  std::optional<double> last = {};
};

/// The obstacle at a rising gap, beside a region.
struct Edge {
  Vec2 place;         ///< [m]
  double side = 1.0;  ///< +1: it stands to the left of the region, -1: to the right.
};

/// The region through which the robot goes on.
struct FreeWalkingArea {
  Region region;
  Vec2 place;  ///< [m] where it goes: the goal, or beside the edge.
  std::optional<Edge>
      edge;  ///< At the rising gap that is nearest to the goal; none if the goal is in the region.

  [[nodiscard]] bool holds_goal() const { return !edge; }
};

/// Returns the area seen from another pose `X_RB` of the robot: its places exactly, its region turned by whole sectors.
[[nodiscard]] FreeWalkingArea seen_from(const Pose2& X_RB, FreeWalkingArea area);

/// Returns whether a circle can come to a place: it finds room there, and no two echoes on different sides of the straight way are so near
/// to each other that it does not pass between them.
///
/// An echo on one side alone does not matter, since the robot can give way. Echoes farther off the way than the circle's diameter do not
/// count, nor those behind the place.
[[nodiscard]] bool is_navigable(std::span<const Vec2> echoes, Vec2 place, double radius);

/// Returns the free walking area: the region that holds the goal, if it is seen and can be reached; otherwise, of the regions that
/// the robot can reach, that with the rising gap nearest to the goal. Returns nothing if it can reach none.
/// @param radius [m]  of the circle that must find room.
[[nodiscard]] std::optional<FreeWalkingArea> free_walking_area(std::span<const Vec2> echoes, const Goal& goal,
                                                               double radius);

}  // namespace orca::nd
