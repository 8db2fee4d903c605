// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/idl/object.hpp"

namespace orca::ros {

/// A message of a type that ROS 2 itself has.
struct RosMessage {
  std::string_view type;  ///< "sensor_msgs/msg/LaserScan": a constant, known to standard_message_type().
  std::vector<std::byte> payload;  ///< CDR, with its encapsulation header of 4 bytes.
};

/// Returns an object as the message of ROS 2 that says the same, for its viewers: LaserRangeReadings, Odometry, RobotPose, GoalPoint, Path,
/// OccupancyGrid, Image, Battery and LogRecord. Frames are those of REP 105: map, odom, base_link and, for what a sensor says, the name of the
/// component that the object comes from; below the context of that component if it has one ("Dewey/base_link").
/// @return nothing if there is no such message.
/// @thread  any.
[[nodiscard]] std::optional<RosMessage> ros_twin(const ObjectRef& object);

/// The frames of robots, from the objects that tell where they are. Where a robot has both odometry and poses in the world,
/// its odometry frame moves in that of the map, as REP 105 has it.
///
/// Thread contract: not synchronised.
class FrameTree {
 public:
  /// Takes an object. @return a tf2_msgs/msg/TFMessage; nothing if it tells nothing of a frame.
  [[nodiscard]] std::optional<RosMessage> hear(const ObjectRef& object);

 private:
  std::map<std::string, Pose2> odometry_;  // of robots, by context: X_OB
};

}  // namespace orca::ros
