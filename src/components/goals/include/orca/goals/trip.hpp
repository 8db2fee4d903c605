// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/idl/navigation.hpp"

namespace orca::go {

/// A doorway without its middle.
struct Doorway {
  double direction = 0.0;  ///< [rad] that leads through it; the opposite one does too.
  double width = 0.0;      ///< [m] of the opening.
};

struct Place {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
  double z = 0.0;  ///< [m] above the floor.
  std::optional<Doorway> door{};
  std::string name{};  ///< A place that a map knows; empty: the coordinates are given.
};

/// A goal and the via points on the way to it.
struct Trip {
  std::string name;
  std::vector<Place> via;  ///< Passed on the way, in order.
  Place goal;
  bool use_orientation = false;
  double orientation = 0.0;  ///< [rad] direction to face at the goal.
};

/// Returns whether a place is farther away than any on Earth, or is no place at all: a coordinate is not a number [m].
[[nodiscard]] bool is_beyond_earth(double x, double y);

/// Reads one trip: `kitchen: 3.1 2 > door 5 2 90 0.9 > 5 4.5 @ 90`. It consists of a name, any via points, and
/// the goal; coordinates are in metres. A third number is the height of the place above the floor. The optional
/// number after `@` is the direction to face at the goal, in degrees. `door` begins a place that is a doorway:
/// x and y of its middle, the direction that leads through it in degrees, and its width in metres. A point may
/// also be the name of a place, whose coordinates stay 0. If the goal is such a name, that of the trip may be
/// left out: `hall > kitchen`.
///
/// @errors  invalid_argument with what was found and what was expected.
[[nodiscard]] Result<Trip> parse_trip(std::string_view text);

/// The demands for having reached a point.
struct Demands {
  double radius = 0.0;      ///< [m]
  double angle = 0.0;       ///< [rad] off the direction at the goal.
  double time_limit = 0.0;  ///< [s] for the way to the goal.
  bool via = false;         ///< Whether it is only passed.
};

/// Returns what Goto gets for a place of a trip: a GoalPoint, or a Door, which is one too. Who sends a robot through a door says
/// that it is passable.
[[nodiscard]] Loan<idl::GoalPoint> point_of(const Trip& trip, const Place& place, const Demands& demands);

}  // namespace orca::go
