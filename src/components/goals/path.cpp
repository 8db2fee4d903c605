// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/path.hpp"

#include <cmath>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/objects/plane.hpp"

namespace orca::go {
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
