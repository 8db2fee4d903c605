// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/legs.hpp"

#include <cmath>

namespace orca::go {
namespace {

constexpr double kOnAxis = 0.1;  // [m] beside the door's axis: lined up

// Returns a place that is only passed, on the way to `end`.
Target on_the_way(const Target& end, Vec2 place, double reach) {
  return {.place = place, .rise = end.rise, .reach_radius = reach, .via = true};
}

std::deque<Target> through(const idl::Door& door, const Pose2& pose, const Manner& manner) {
  const Target middle = target_of(door, manner);
  const Pose2 X_WD{middle.place.x, middle.place.y, door.orientation().orientation().yaw()};
  const Vec2 here = seen_from(X_WD, pose.position());
  const double side = here.x < 0.0 ? -1.0 : 1.0;  // -1: the door's orientation leads through it
  std::deque<Target> legs;
  if (std::abs(here.y) > kOnAxis || std::abs(here.x) > manner.run_up)
    legs.push_back(on_the_way(middle, X_WD * Vec2{side * manner.run_up, 0.0}, kOnAxis));
  legs.push_back(door.via() ? on_the_way(middle, X_WD * Vec2{-side * manner.run_up, 0.0}, middle.reach_radius)
                            : middle);
  return legs;
}

}  // namespace

Target target_of(const idl::GoalPoint& point, const Manner& manner) {
  const auto& place = point.coordinate().point();
  return {.place = {place.x(), place.y()},
          .rise = place.z() - manner.height,
          .reach_radius = point.reach_radius().distance(),
          .use_orientation = point.use_orientation(),
          .orientation = point.orientation().orientation().yaw(),
          .reach_angle = point.reach_angle(),
          .via = point.via()};
}

std::deque<Target> legs_to(const Route::Point& point, const Pose2& pose, const Manner& manner) {
  if (const auto door = point.as<idl::Door>()) return through(*door, pose, manner);
  return {target_of(*point, manner)};
}

const Target& Legs::next(const Route::Point& point, const Pose2& pose, const Manner& manner) {
  if (point != point_ || legs_.empty()) {
    point_ = point;
    legs_ = legs_to(point, pose, manner);
  }
  return legs_.front();
}

}  // namespace orca::go
