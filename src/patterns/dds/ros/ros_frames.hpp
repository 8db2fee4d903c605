// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/mutex.hpp"
#include "orca/base/strand.hpp"
#include "orca/ros/frame_tree.hpp"
#include "ros_participant.hpp"

namespace orca::dds::of_ros {

/// Wakes a strand from threads of DDS, for as long as the strand's port is there.
class Bell {
 public:
  explicit Bell(Strand& strand) : strand_(&strand) {}
  void ring() {
    const MutexLock lock(mutex_);
    if (strand_ != nullptr) strand_->wake();
  }
  void remove() {
    const MutexLock lock(mutex_);
    strand_ = nullptr;
  }

 private:
  Mutex mutex_;
  Strand* strand_ ORCA_GUARDED_BY(mutex_);
};

/// The transforms that this process says on /tf and /tf_static, and those that others say there.
///
/// Thread contract: publish() and listen() from one thread; say() from another one; the rest from any.
class RosFrames {
 public:
  explicit RosFrames(RosParticipant& participant) : participant_(participant) {}

  /// Begins to say what objects know of frames. Once is enough.
  /// @errors  those of make_writer().
  Status publish();
  /// Begins to hear what others say. Once is enough.
  /// @errors  those of make_reader().
  Status listen();

  /// Returns whether others hear on /tf how robots move, and for whom objects are wanted that nobody reads.
  [[nodiscard]] bool are_heard() const;
  /// Rings when that has changed.
  void add(std::weak_ptr<Bell> bell);

  /// Says what an object knows of a frame, after publish(). Mounts are said again only if they have changed.
  void say(const ObjectRef& object);
  [[nodiscard]] std::optional<idl::Frame3D> mount_of(const std::string& frame) const;

  /// Returns the names of its writers and readers.
  [[nodiscard]] std::vector<Gid> writers() const;
  [[nodiscard]] std::vector<Gid> readers() const;

 private:
  Result<std::unique_ptr<RosReader>> hear(const std::string& topic, bool is_latched);
  void ring();
  void say_static(const ros::tf2_msgs::TFMessage& message, RosWriter& writer);

  RosParticipant& participant_;
  mutable Mutex mutex_;
  ros::FrameTree tree_ ORCA_GUARDED_BY(mutex_);
  std::map<std::string, ros::geometry_msgs::TransformStamped>
      mounted_;  // by child; what was said on /tf_static
  std::vector<std::weak_ptr<Bell>> bells_ ORCA_GUARDED_BY(mutex_);
  std::shared_ptr<RosWriter> moving_ ORCA_GUARDED_BY(mutex_);
  std::shared_ptr<RosWriter> static_ ORCA_GUARDED_BY(mutex_);
  std::unique_ptr<RosReader> heard_moving_;  // after tree_, which their callbacks use
  std::unique_ptr<RosReader> heard_static_;
};

}  // namespace orca::dds::of_ros
