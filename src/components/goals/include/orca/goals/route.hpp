// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <tuple>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
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
  /// Lets a time not count, in which the robot could not be on its way.
  void delay(Duration time) { begun_ += time; }
  /// Returns how long the robot has been on this route, without such times [s].
  [[nodiscard]] double age(TimePoint now) const { return to_seconds(now - begun_); }

  /// Returns all of it, to be passed on to another version of Goto.
  auto state() { return std::tie(points_, begun_, given_up_, changes_); }

 private:
  std::deque<Point> points_;
  TimePoint begun_{};
  std::uint64_t given_up_ = 0;
  std::uint64_t changes_ = 0;
};

/// Returns why a robot on the floor cannot take that goal, to be read after "it"; null if it can. The uncertainties of
/// the goal are not considered.
/// @param height [m]  of the robot in the frame of the goal.
[[nodiscard]] const char* fault_of(const idl::GoalPoint& goal, double height);

/// Returns why the robot cannot go through that door; null if it can. A width of 0 is not known.
/// @param room [m]  width that the robot needs.
[[nodiscard]] const char* fault_of_door(const idl::Door& door, double room);

/// Fills in the way that is left: the robot's pose, then the points of the route, which give the path its name. A
/// pose on the way looks along the way that leads to it, and the last one as the goal asks. Without a route the path
/// is empty. The uncertainties of the points are left out.
/// @param here  of the robot, in the frame of the points.
/// @param height [m]  of the robot in that frame.
void fill_path(const Route& route, const Pose2& here, double height, idl::Path& path);

}  // namespace orca::go
