// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "goal_list.hpp"
#include "orca/idl/navigation.hpp"

namespace orca::command {

/// What counts as having reached a point.
struct Demands {
  double radius = 0.0;      ///< [m]
  double angle = 0.0;       ///< [rad] off the direction at the goal.
  double time_limit = 0.0;  ///< [s] for the way to the goal.
  bool via = false;         ///< Whether it is only passed.
};

/// Returns what Goto gets for a place of a route: a GoalPoint, or a Door, which is one too. Who sends a robot through a door says
/// that it is passable.
[[nodiscard]] Loan<idl::GoalPoint> point_of(const Route& route, const Place& place, const Demands& demands);

}  // namespace orca::command
