// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/component.hpp"
#include "orca/goals/trip.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/ways.hpp"

namespace orca::go {

/// The side of whoever drives by a topological map, in one component: it asks a RouteServer for the places on the way to a goal. A member of
/// the component: it declares the ports.
///
/// Thread contract: as the component that it belongs to.
class RouteProxy {
 public:
  explicit RouteProxy(Component& owner);

  /// Returns whether there is somebody to be asked.
  [[nodiscard]] bool connected() const { return routes_.connected(); }
  /// Begins another trip, of which no route is known.
  void begin();
  /// Ends the trip.
  void end();

  /// Lays the via points of a trip along the cheapest route from the robot to its goal.
  /// @return whether that is another way, not only less of the one before. After report_blocked(), to leave a place out is another way, and
  ///         one that is known to be blocked, too, is none.
  /// @errors  those of the server: not_found: no way leads there. unavailable: it can be asked again later. Then the trip stays as it was.
  [[nodiscard]] Result<bool> lay(Trip& trip);

  /// Returns the names of its places, for people.
  [[nodiscard]] std::string text() const;

  /// Returns the port that speaks when a door has been found shut, or open again.
  [[nodiscard]] PushProxy<idl::Door>& doors() { return doors_; }

  /// Reports that the leg to a via point of the trip, or to its goal, is blocked.
  /// @param left  number of points before the robot, the goal included.
  /// @pre  left > 0
  [[nodiscard]] Status report_blocked(const Trip& trip, std::size_t left);

 private:
  QueryProxy<idl::GoalPoint, idl::Route> routes_;
  PushProxy<idl::Door> doors_;
  SendProxy<idl::Route> blocked_;

  std::vector<std::string> names_;  // of the via points
  bool is_blocked_ = false;         // The first of them, or the goal, cannot be reached as it was tried.
};

/// Returns the via points of a route.
[[nodiscard]] std::vector<Place> places_of(const idl::Route& route);

/// Returns whether `later` is what is left of `before` when some of its first places have been passed.
[[nodiscard]] bool is_rest_of(const std::vector<std::string>& before, const std::vector<std::string>& later);

}  // namespace orca::go
