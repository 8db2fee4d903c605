// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sightings.hpp"

#include <cmath>

#include "orca/base/portable_math.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::host {
namespace {

template <class T>
const T* as(const ObjectRef& object) {
  return &object.type() == &object_type<T>() ? static_cast<const T*>(object.get()) : nullptr;
}

// Returns the value of a name. Only a new name costs memory.
template <class Map>
auto& entry(Map& map, std::string_view name) {
  const auto found = map.find(name);
  return found != map.end() ? found->second : map[std::string(name)];
}

}  // namespace

void Sightings::delivered(std::string_view component, const ObjectRef& object) {
  if (const auto* pose = as<idl::RobotPose>(object)) return note_pose(component, *pose, located_, false);
  if (const auto* odometry = as<idl::Odometry>(object)) return note_pose(component, *odometry, driven_, true);
  if (const auto* goal = as<idl::GoalPoint>(object)) note_goal(*goal);
}

template <class Posed>
void Sightings::note_pose(std::string_view component, const Posed& object, ByName<Track>& tracks,
                          bool odometry) {
  const std::lock_guard lock(mutex_);
  const Place place{object.x(), object.y()};
  if (const auto known = poses_.find(component);
      !odometry || known == poses_.end() || known->second.from_odometry)
    entry(poses_, component) = {place, odometry};
  Track& track = entry(tracks, object.origin());
  if (object.seq() <= track.last_seq) return;  // another component has received it before
  if (track.last_seq > 0) track.way += portable::hypot(place.x - track.last.x, place.y - track.last.y);
  track.last_seq = object.seq();
  track.last = place;
}

void Sightings::note_goal(const idl::GoalPoint& goal) {
  const std::lock_guard lock(mutex_);
  Goal& noted = entry(goals_, goal.origin());
  const auto& place = goal.coordinate().point();
  noted.place = {place.x(), place.y()};
  if (noted.name != goal.name()) noted.name = goal.name();
}

std::vector<RunGlance::Goal> Sightings::goals() const {
  const std::lock_guard lock(mutex_);
  std::vector<RunGlance::Goal> goals;
  for (const auto& [component, goal] : goals_)
    if (const auto pose = poses_.find(component); pose != poses_.end())
      goals.push_back({goal.name, portable::hypot(goal.place.x - pose->second.place.x,
                                                  goal.place.y - pose->second.place.y)});
  return goals;
}

std::vector<RunResult::Way> Sightings::ways() const {
  const std::lock_guard lock(mutex_);
  std::vector<RunResult::Way> ways;
  for (const auto& [robot, track] : driven_.empty() ? located_ : driven_) ways.push_back({robot, track.way});
  return ways;
}

}  // namespace orca::host
