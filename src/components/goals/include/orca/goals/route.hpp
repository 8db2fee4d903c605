// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <tuple>

#include "orca/base/time.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/object.hpp"

namespace orca::go {

/// The points to drive to, in order: via points, then a goal. Points that belong to one mission make one
/// route.
class Route {
 public:
  using Point = ObjectPtr<idl::GoalPoint>;

  /// Adds a point. It begins a new route if the present one ends in a goal or belongs to another mission.
  void add(const Point& point, TimePoint now);
  /// Gives up the points of a mission, and refuses those that come later. Points of no mission (0) may come
  /// again.
  void give_up(std::uint64_t mission);
  /// Returns whether the route to which this point belongs has been given up.
  [[nodiscard]] bool is_given_up(const idl::GoalPoint& point) const;

  [[nodiscard]] bool empty() const { return points_.empty(); }
  /// @pre  not empty.
  [[nodiscard]] const idl::GoalPoint& next() const { return *point(); }
  [[nodiscard]] const Point& point() const { return points_.front(); }
  [[nodiscard]] const std::deque<Point>& points() const { return points_; }
  void pop() {
    points_.pop_front();
    ++changes_;
  }
  /// Returns a number that grows whenever the points change.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  /// Returns how long the robot has been on this route [s].
  [[nodiscard]] double age(TimePoint now) const { return to_seconds(now - begun_); }

  /// Returns all of it, to be passed on to another version of Goto.
  auto state() { return std::tie(points_, begun_, given_up_, changes_); }

 private:
  std::deque<Point> points_;
  TimePoint begun_{};
  std::uint64_t given_up_ = 0;
  std::uint64_t changes_ = 0;
};

}  // namespace orca::go
