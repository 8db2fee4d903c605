// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/idl/navigation.hpp"

namespace orca::command {

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

/// A line of a file of goals.
struct GoalLine {
  std::string text;
  std::string place;  ///< For messages: "FILE:LINE:1".
};

/// Reads a file of goals, without its empty lines and comments.
/// @errors  those of read_input_file(); invalid_argument if it has more than 1 MB.
[[nodiscard]] Result<std::vector<GoalLine>> read_goal_file(const std::string& path);

/// The demands for having reached a point.
struct Demands {
  double radius = 0.0;      ///< [m]
  double angle = 0.0;       ///< [rad] off the direction at the goal.
  double time_limit = 0.0;  ///< [s] for the way to the goal.
  bool via = false;         ///< Whether it is only passed.
};

/// Returns what Goto gets for a place of a route: a GoalPoint, or a Door, which is one too. Who sends a robot through a door says
/// that it is passable.
[[nodiscard]] Loan<idl::GoalPoint> point_of(const Route& route, const Place& place, const Demands& demands);

/// The goals of a list, and how far it is driven: once, in several rounds, or in rounds without end.
///
/// Thread contract: not synchronised.
class Agenda {
 public:
  /// Begins another list.
  void set(std::vector<Route> routes) {
    routes_ = std::move(routes);
    begun_ = 0;
  }
  [[nodiscard]] bool empty() const { return routes_.empty(); }

  /// Returns the goal that is to be driven to now; null after the last one.
  /// @param rounds  in which the list is driven; 0: without end.
  [[nodiscard]] const Route* next(std::size_t rounds) const {
    if (routes_.empty() || (rounds > 0 && begun_ >= rounds * routes_.size())) return nullptr;
    return &routes_[begun_ % routes_.size()];
  }
  /// Takes note that the robot is driven to the next goal.
  void begin() { ++begun_; }

  /// Returns how many goals of this list were begun, in all rounds.
  [[nodiscard]] std::size_t begun() const { return begun_; }
  void go_on_after(std::size_t begun) { begun_ = begun; }

 private:
  std::vector<Route> routes_;
  std::size_t begun_ = 0;
};

}  // namespace orca::command
