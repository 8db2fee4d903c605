// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "orca/geometry/pose2.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/object.hpp"
#include "orca/ros/generated/messages.hpp"
#include "orca/ros/twin.hpp"

namespace orca::ros {

/// What one object says of frames: a transform, or those of a ring of sensors.
struct FrameNews {
  tf2_msgs::TFMessage message;
  bool is_static = false;  ///< They say how something is mounted: /tf_static in ROS.
};

/// The frames of robots, from the objects that tell where they are. Where a robot has both odometry and poses in the world,
/// its odometry frame moves in that of the map, as REP 105 has it.
///
/// Thread contract: not synchronised.
class FrameTree {
 public:
  /// Takes an object. A pose belongs to the odometry of its stamp.
  /// @return nothing if it tells nothing of a frame.
  [[nodiscard]] std::optional<FrameNews> hear(const ObjectRef& object);

  /// Takes what others say of frames: where they say how a robot has moved in its odometry frame, hear() need not be told.
  void learn(const tf2_msgs::TFMessage& message);

  /// Returns the pose of a frame in base_link of the same robot, from what learn() was given; nothing if they do not hang together.
  [[nodiscard]] std::optional<idl::Frame3D> mount_of(const std::string& frame) const;

 private:
  // Where a robot was in its odometry frame.
  struct Moment {
    TimePoint stamp;
    Pose2 X_OB;
  };

  [[nodiscard]] std::optional<idl::Frame3D> chain(const std::string& frame, const std::string& end) const;
  void note_odometry(const std::string& context, TimePoint stamp, const Pose2& X_OB);
  [[nodiscard]] std::optional<Pose2> odometry_at(const std::string& context, TimePoint instant) const;

  std::map<std::string, std::deque<Moment>> odometry_;                               // of robots, by context
  std::map<std::string, std::pair<std::string, geometry_msgs::Transform>> parents_;  // of frames, and X_PF
};

/// Returns how the sensors of a ring are mounted, which viewers and recordings are not given with each round of it.
/// @return nothing for what is no ring of sonars or infrared sensors.
/// @thread  any.
[[nodiscard]] std::optional<FrameNews> mounts_of_ring(const ObjectRef& object);

}  // namespace orca::ros
