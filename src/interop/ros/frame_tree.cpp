// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/ros/frame_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "convert.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::ros {
namespace {

constexpr int kLongestChain = 20;            // of frames, so that a circle ends
constexpr std::size_t kMostFrames = 10'000;  // that others may name
constexpr std::size_t kMostMoments = 100;    // of odometry that are remembered: at least a second

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

// Returns whether a frame has that name, below any context.
bool is_called(const std::string& frame, const std::string& name) {
  return frame == name || frame.ends_with("/" + name);
}

bool is_finite(const geometry_msgs::Transform& transform) {
  const auto& [x, y, z, w] = transform.rotation;
  const geometry_msgs::Vector3& t = transform.translation;
  return std::isfinite(t.x + t.y + t.z) && std::isfinite(x * x + y * y + z * z + w * w) &&
         x * x + y * y + z * z + w * w > 0.0;
}

}  // namespace

std::optional<FrameNews> FrameTree::hear(const ObjectRef& object) {
  const std::string context = context_of(object.header());
  const std::string base = context + "base_link";
  const auto one = [&](std::string parent, std::string child, const geometry_msgs::Pose& pose,
                       bool is_static) {
    return FrameNews{{{transform(object.stamp(), std::move(parent), std::move(child), pose)}}, is_static};
  };
  if (const auto odometry = object_cast<idl::Odometry>(object)) {
    const Pose2 X_OB = plane_pose(*odometry);
    note_odometry(context, object.stamp(), X_OB);
    return one(context + "odom", base, to_ros_pose(X_OB), false);
  }
  if (const auto pose = object_cast<idl::RobotPose>(object)) {
    const Pose2 X_WB = plane_pose(*pose);
    if (const std::optional<Pose2> X_OB = odometry_at(context, object.stamp()))
      return one("map", context + "odom", to_ros_pose(X_WB * inverse(*X_OB)), false);
    if (parents_.contains(base)) return std::nullopt;  // somebody else moves it, and has not said how in odom
    return one("map", base, to_ros_pose(X_WB), false);
  }
  const auto mounted = [&](const idl::Pose3D& mount) {
    return one(base, sensor_frame(object.header()), to_ros_pose(mount.position(), mount.rotation()), true);
  };
  if (const auto scan = object_cast<idl::LaserRangeReadings>(object)) return mounted(scan->pose());
  if (const auto image = object_cast<idl::Image>(object))
    return one(base, optical_frame(object.header()),
               to_ros_pose(image->pose().position(), to_optical(image->pose().rotation())), true);
  return std::nullopt;
}

std::optional<FrameNews> mounts_of_ring(const ObjectRef& object) {
  const std::string base = context_of(object.header()) + "base_link";
  if (const auto ring = object_cast<idl::SonarRangeReadings>(object))
    return mounts_of(*ring, object.stamp(), base);
  if (const auto ring = object_cast<idl::InfraredRangeReadings>(object))
    return mounts_of(*ring, object.stamp(), base);
  return std::nullopt;
}

void FrameTree::learn(const tf2_msgs::TFMessage& message) {
  for (const geometry_msgs::TransformStamped& said : message.transforms) {
    if (!is_finite(said.transform) ||
        std::max(said.child_frame_id.size(), said.header.frame_id.size()) > kLongestFrame)
      continue;
    if (parents_.size() >= kMostFrames && !parents_.contains(said.child_frame_id)) continue;
    parents_[said.child_frame_id] = {said.header.frame_id, said.transform};
    if (!is_called(said.header.frame_id, "odom")) continue;
    const std::string& odom = said.header.frame_id;
    const std::string context = odom.substr(0, odom.size() - std::string_view("odom").size());
    const auto X_OB = chain(context + "base_link", "odom");
    if (X_OB) note_odometry(context, to_instant(said.header.stamp), plane_pose(*X_OB));
  }
}

std::optional<idl::Frame3D> FrameTree::mount_of(const std::string& frame) const {
  return chain(frame, "base_link");
}

// Returns the pose of a frame in the nearest one above it that has that name.
std::optional<idl::Frame3D> FrameTree::chain(const std::string& frame, const std::string& end) const {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  std::string at = frame;
  for (int i = 0; i < kLongestChain; ++i) {
    if (is_called(at, end)) return to_frame(X);
    const auto parent = parents_.find(at);
    if (parent == parents_.end()) return std::nullopt;
    X = to_eigen(parent->second.second) * X;
    at = parent->second.first;
  }
  return std::nullopt;
}

void FrameTree::note_odometry(const std::string& context, TimePoint stamp, const Pose2& X_OB) {
  std::deque<Moment>& moments = odometry_[context];
  moments.push_back({stamp, X_OB});
  if (moments.size() > kMostMoments) moments.pop_front();
}

// Returns where the robot was in its odometry frame at an instant, or at the nearest known.
std::optional<Pose2> FrameTree::odometry_at(const std::string& context, TimePoint instant) const {
  const auto known = odometry_.find(context);
  if (known == odometry_.end()) return std::nullopt;
  const auto number = [](TimePoint time) {  // unsigned, since what comes from a network may hold any number
    return static_cast<std::uint64_t>(time.time_since_epoch().count());
  };
  const auto away = [&](const Moment& moment) {
    return moment.stamp > instant ? number(moment.stamp) - number(instant)
                                  : number(instant) - number(moment.stamp);
  };
  return std::ranges::min_element(known->second, {}, away)->X_OB;
}

}  // namespace orca::ros
