// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/ros/frame_tree.hpp"

#include <Eigen/Geometry>

#include "convert.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::ros {
namespace {

constexpr int kLongestChain = 20;  // of frames, so that a circle ends

geometry_msgs::TransformStamped transform(TimePoint stamp, std::string parent, std::string child,
                                          const geometry_msgs::Pose& pose) {
  return {make_header(stamp, std::move(parent)), std::move(child), to_transform(pose)};
}

Eigen::Isometry3d to_eigen(const geometry_msgs::Transform& transform) {
  const auto& [x, y, z, w] = transform.rotation;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() =
      Eigen::Vector3d(transform.translation.x, transform.translation.y, transform.translation.z);
  X.linear() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  return X;
}

idl::Frame3D to_frame(const Eigen::Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  idl::Frame3D frame;
  frame.position(make_point(X.translation().x(), X.translation().y(), X.translation().z()));
  frame.rotation(to_rotation(geometry_msgs::Quaternion{q.x(), q.y(), q.z(), q.w()}));
  return frame;
}

// Returns how the sensors of a ring are mounted.
template <class Ring>
FrameNews mounts_of(const Ring& ring, TimePoint stamp, const std::string& base) {
  FrameNews news{{}, true};
  for (std::size_t i = 0; i < ring.poses().size(); ++i) {
    const idl::Frame3D& place = ring.poses()[i];
    news.message.transforms.push_back(transform(stamp, base, sensor_frame(ring, i, ring.poses().size()),
                                                to_ros_pose(place.position(), place.rotation())));
  }
  return news;
}

bool ends_with(const std::string& text, std::string_view end) { return text.ends_with(end); }

}  // namespace

std::optional<FrameNews> FrameTree::hear(const ObjectRef& object) {
  const std::string context = context_of(object.header());
  const std::string base = context + "base_link";
  const auto one = [&](std::string parent, std::string child, const geometry_msgs::Pose& pose,
                       bool is_static) {
    return FrameNews{{{transform(object.stamp(), std::move(parent), std::move(child), pose)}}, is_static};
  };
  if (const auto odometry = object_cast<idl::Odometry>(object)) {
    const Pose2& X_OB = odometry_[context] = plane_pose(*odometry);
    return one(context + "odom", base, to_ros_pose(X_OB), false);
  }
  if (const auto pose = object_cast<idl::RobotPose>(object)) {
    const Pose2 X_WB = plane_pose(*pose);
    const auto known = odometry_.find(context);
    if (known == odometry_.end()) return one("map", base, to_ros_pose(X_WB), false);
    return one("map", context + "odom", to_ros_pose(X_WB * inverse(known->second)), false);
  }
  const auto mounted = [&](const idl::Pose3D& mount) {
    return one(base, sensor_frame(object.header()), to_ros_pose(mount.position(), mount.rotation()), true);
  };
  if (const auto scan = object_cast<idl::LaserRangeReadings>(object)) return mounted(scan->pose());
  if (const auto image = object_cast<idl::Image>(object)) return mounted(image->pose());
  if (const auto ring = object_cast<idl::SonarRangeReadings>(object))
    return mounts_of(*ring, object.stamp(), base);
  if (const auto ring = object_cast<idl::InfraredRangeReadings>(object))
    return mounts_of(*ring, object.stamp(), base);
  return std::nullopt;
}

void FrameTree::learn(const tf2_msgs::TFMessage& message) {
  constexpr std::string_view kBase = "base_link";
  for (const geometry_msgs::TransformStamped& said : message.transforms) {
    parents_[said.child_frame_id] = {said.header.frame_id, said.transform};
    if (!ends_with(said.child_frame_id, kBase) || !ends_with(said.header.frame_id, "odom")) continue;
    const std::string context = said.child_frame_id.substr(0, said.child_frame_id.size() - kBase.size());
    const geometry_msgs::Transform& X = said.transform;
    odometry_[context] = to_plane({{X.translation.x, X.translation.y, X.translation.z}, X.rotation});
  }
}

std::optional<idl::Frame3D> FrameTree::mount_of(const std::string& frame) const {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  std::string at = frame;
  for (int i = 0; i < kLongestChain; ++i) {
    if (ends_with(at, "base_link")) return to_frame(X);
    const auto parent = parents_.find(at);
    if (parent == parents_.end()) return std::nullopt;
    X = to_eigen(parent->second.second) * X;
    at = parent->second.first;
  }
  return std::nullopt;
}

}  // namespace orca::ros
