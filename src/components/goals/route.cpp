// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/route.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/goals/trip.hpp"

namespace orca::go {

void Route::add(const Point& point, TimePoint now) {
  if (!points_.empty() && (!points_.back()->via() || points_.back()->mission() != point->mission()))
    points_.clear();
  if (points_.empty()) begun_ = now;
  points_.push_back(point);
  ++changes_;
}

void Route::give_up(std::uint64_t mission) {
  std::erase_if(points_, [mission](const Point& point) { return point->mission() == mission; });
  given_up_ = mission;
  ++changes_;
}

bool Route::is_given_up(const idl::GoalPoint& point) const {
  return given_up_ != 0 && point.mission() == given_up_;
}

namespace {

bool is_finite(const idl::GoalPoint& goal) {
  const auto& place = goal.coordinate().point();
  const auto& facing = goal.orientation().orientation();
  for (const double number : {place.x(), place.y(), place.z(), facing.roll(), facing.pitch(), facing.yaw(),
                              goal.reach_radius().distance(), goal.reach_angle()})
    if (!std::isfinite(number)) return false;
  return true;
}

// Returns whether the orientation is that of a robot on the floor, as far as the goal cares.
bool is_level(const idl::GoalPoint& goal) {
  const auto& facing = goal.orientation().orientation();
  return std::abs(std::remainder(facing.roll(), 2.0 * M_PI)) <= goal.reach_angle() &&
         std::abs(std::remainder(facing.pitch(), 2.0 * M_PI)) <= goal.reach_angle();
}

}  // namespace

const char* fault_of(const idl::GoalPoint& goal, double height) {
  const auto& place = goal.coordinate().point();
  if (!is_finite(goal)) return "holds a number that is not finite";
  if (is_beyond_earth(place.x(), place.y())) return "lies farther away than any place on Earth";
  const double reach = goal.reach_radius().distance();
  if (reach < 0.0) return "has a negative reach_radius";
  if (!(goal.time_limit() >= 0.0)) return "has a time_limit that is negative, or no number";
  if (goal.use_orientation() && goal.reach_angle() <= 0.0)
    return "has an orientation to take with a reach_angle that is not positive";
  if (goal.use_orientation() && !is_level(goal))
    return "has an orientation to take that rolls or pitches the robot by more than its reach_angle";
  if (reach > 0.0 && std::abs(goal.coordinate().point().z() - height) >= reach)
    return "lies so far above or below the robot that no place on the floor is within its reach_radius";
  return nullptr;
}

const char* fault_of_door(const idl::Door& door, double room) {
  const double width = door.door_width().distance();
  if (!std::isfinite(width)) return "holds a number that is not finite";
  if (width < 0.0) return "is a door of negative width";
  if (!door.passable()) return "is a door that is not passable";
  if (width > 0.0 && width < room) return "is a door narrower than Goto's door_room";
  return nullptr;
}

namespace {

idl::Pose3D pose_at(const idl::GoalPoint& point, const idl::Point& before) {
  idl::Pose3D pose;
  pose.position(point.coordinate().point());
  if (point.use_orientation() && !point.via()) {
    pose.rotation(point.orientation().orientation());
  } else {
    pose.rotation().yaw(portable::atan2(pose.position().y() - before.y(), pose.position().x() - before.x()));
  }
  return pose;
}

}  // namespace

void fill_path(const Route& route, const Pose2& here, double height, idl::Path& path) {
  path.name().clear();
  path.poses().clear();
  if (route.empty()) return;
  path.name() = route.points().back()->name();
  path.poses().push_back(level_pose(here, height, TimePoint{}));
  for (const Route::Point& point : route.points())
    path.poses().push_back(pose_at(*point, path.poses().back().position()));
}

}  // namespace orca::go
