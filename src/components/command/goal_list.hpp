// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::command {

/// What is known of a doorway besides its middle.
struct Doorway {
  double direction = 0.0;  ///< [rad] that leads through it; the opposite one does too.
  double width = 0.0;      ///< [m] of the opening.
};

struct Place {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
  double z = 0.0;  ///< [m] above the floor.
  std::optional<Doorway> door{};
  std::string name{};  ///< Of a place that a map knows; empty: the coordinates are given.
};

/// A goal and the via points on the way to it.
struct Route {
  std::string name;
  std::vector<Place> via;  ///< Passed on the way, in order.
  Place goal;
  bool use_orientation = false;
  double orientation = 0.0;  ///< [rad] direction to face at the goal.
};

/// Reads one route: `kitchen: 3.1 2 > door 5 2 90 0.9 > 5 4.5 @ 90`. It consists of a name, any via points, and
/// the goal; coordinates are in metres. A third number is the height of the place above the floor. The optional
/// number after `@` is the direction to face at the goal, in degrees. `door` begins a place that is a doorway:
/// x and y of its middle, the direction that leads through it in degrees, and its width in metres. A point may
/// also be the name of a place, whose coordinates stay 0. If the goal is such a name, that of the route may be
/// left out: `hall > kitchen`.
///
/// @errors  invalid_argument with what was found and what was expected.
[[nodiscard]] Result<Route> parse_route(std::string_view text);

}  // namespace orca::command
