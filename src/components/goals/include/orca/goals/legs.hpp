// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <utility>

#include "orca/goals/route.hpp"
#include "orca/goals/target.hpp"

namespace orca::go {

/// The way in which the robot takes points.
struct Manner {
  double height = 0.0;  ///< [m] of the robot in the frame of the points.
  double run_up = 0.0;  ///< [m] before a door where it lines up, and behind it where it is through.
};

/// Returns a point as a target: the place, reach and direction that its sender gave it.
[[nodiscard]] Target target_of(const idl::GoalPoint& point, const Manner& manner);

/// Returns the places that lead to a point, in order. It is the point itself, unless that is a Door: the robot
/// then lines up in front of it, on its own side, and drives straight to the middle, or as far behind it if
/// the door is a via point. It need not line up if it stands in front of the door already.
///
/// @param pose  of the robot now, in the frame of the point.
[[nodiscard]] std::deque<Target> legs_to(const Route::Point& point, const Pose2& pose, const Manner& manner);

/// The places that lead to the next point of a route, as far as the robot still has to go there.
class Legs {
 public:
  /// Returns the place to drive to now. The places are laid out again when the point is another one.
  const Target& next(const Route::Point& point, const Pose2& pose, const Manner& manner);
  /// Returns whether the place is the last one for its point.
  /// @pre  next() has been called since the last pop().
  [[nodiscard]] bool at_last() const { return legs_.size() == 1; }
  void pop() { legs_.pop_front(); }

  /// Returns the places that are left for a point; none if they are not laid out.
  [[nodiscard]] std::deque<Target> left_for(const Route::Point& point) const {
    return point == point_ ? legs_ : std::deque<Target>{};
  }
  /// Takes over places that were left for a point.
  void take(const Route::Point& point, std::deque<Target> left) {
    point_ = point;
    legs_ = std::move(left);
  }

 private:
  Route::Point point_;
  std::deque<Target> legs_;
};

}  // namespace orca::go
