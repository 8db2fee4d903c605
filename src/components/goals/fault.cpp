// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/fault.hpp"

#include <cmath>

namespace orca::go {
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
  if (!is_finite(goal)) return "holds a number that is not finite";
  const double reach = goal.reach_radius().distance();
  if (reach < 0.0) return "has a negative reach_radius";
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
  if (!door.passable()) return "is a door that is not passable";
  if (width > 0.0 && width < room) return "is a door narrower than Goto's door_room";
  return nullptr;
}

}  // namespace orca::go
