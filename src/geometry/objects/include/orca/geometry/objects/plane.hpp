// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Conversions between values of the plane and objects that travel. Heights, roll, pitch, stamps and
/// covariances, which the plane has no place for, are left out.
#pragma once

#include "orca/geometry/pose2.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace orca {

/// Returns X_RS, the pose of a sensor in the robot frame, seen from above.
/// @thread  pure function, as all of this file; any thread.
[[nodiscard]] inline Pose2 plane_pose(const idl::Frame3D& mount) {
  return {mount.position().x(), mount.position().y(), mount.rotation().yaw()};
}

/// Returns X_AB, seen from above, without its covariance and stamp.
[[nodiscard]] inline Pose2 plane_pose(const idl::Pose3D& X_AB) {
  return {X_AB.position().x(), X_AB.position().y(), X_AB.rotation().yaw()};
}

/// Returns X_WR, the pose of the robot in the world.
[[nodiscard]] inline Pose2 plane_pose(const idl::RobotPose& pose) {
  return {pose.x(), pose.y(), pose.orientation()};
}

/// Returns X_OR, the pose of the robot in the frame of its odometry.
[[nodiscard]] inline Pose2 plane_pose(const idl::Odometry& odometry) {
  return {odometry.x(), odometry.y(), odometry.steer_angle()};
}

/// Returns X_AB without its covariance and stamp.
[[nodiscard]] inline Pose2 plane_pose(const idl::Pose2D& X_AB) {
  return {X_AB.x(), X_AB.y(), X_AB.orientation()};
}

/// Returns the frame of something mounted level, `height` [m] above the floor.
[[nodiscard]] inline idl::Frame3D level_frame(const Pose2& pose, double height) {
  return make_frame(make_point(pose.x, pose.y, height), pose.yaw);
}

/// Returns the pose of something level, `height` [m] above the floor, at an instant. Its covariance is not known.
[[nodiscard]] inline idl::Pose3D level_pose(const Pose2& pose, double height, TimePoint stamp) {
  idl::Pose3D level;
  level.position(make_point(pose.x, pose.y, height));
  level.rotation().yaw(pose.yaw);
  level.stamp(to_time_value(stamp));
  return level;
}

}  // namespace orca
