// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::command {

struct Place {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
  double z = 0.0;  ///< [m] above the floor.
};

/// A goal and how to get there.
struct Route {
  std::string name;
  std::vector<Place> via;  ///< Passed on the way, in order.
  Place goal;
  bool use_orientation = false;
  double orientation = 0.0;  ///< [rad] to face at the goal.
};

/// Reads one route: `kitchen: 3.1 2 > 5 2 > 5 4.5 @ 90`, that is a name, via points and last the goal in
/// metres (a third number is the height of the place above the floor), and if wanted after `@` the direction
/// to face there in degrees.
///
/// @errors  invalid_argument with what was found and what was expected.
[[nodiscard]] Result<Route> parse_route(std::string_view text);

}  // namespace orca::command
