// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/object.hpp"

namespace orca::ros {

/// A message of a type that ROS 2 itself has.
struct RosMessage {
  std::string_view type;  ///< "sensor_msgs/msg/LaserScan": a constant, known to standard_message_type().
  std::vector<std::byte> payload;  ///< CDR, with its encapsulation header of 4 bytes.
};

/// Returns the pose of a frame of ROS in its robot's base_link; nothing if it is not known.
using MountOf = std::function<std::optional<idl::Frame3D>(const std::string& frame)>;

/// An object type and a message of ROS 2 that says the same. Frames are those of REP 105: map, odom, base_link and, for what a
/// sensor says, the name of the component that the object comes from; below the context of that component if it has one
/// ("Dewey/base_link"). Angles, ranges and units are those of REP 103 and 117.
///
/// Thread contract: constant; the functions may run in any thread.
struct Twin {
  const ObjectType& object;
  std::string_view message;  ///< "sensor_msgs/msg/LaserScan"
  /// Whether viewers and recordings get the message beside the object.
  bool is_shown;
  /// Whether a reader that comes later wants the latest message: a map, as opposed to a scan.
  bool is_latched;
  /// Appends the messages of an object of that type or a derived one: as a rule one, of a ring of sonars one for each, and of an object
  /// that has nothing to say to ROS none. Null: not in this direction.
  void (*to_ros)(const ObjectRef& object, std::vector<std::vector<std::byte>>& payloads);
  /// Returns the object that a message says. Its header's creation_time is the message's stamp, or if it has none when it came; its
  /// origin is the message's frame.
  /// @param mount_of  where sensors are. What is not known is taken to be in the middle of the robot.
  /// @errors  data_loss for bytes that are no such message, or that no such object can say. Null: not in this direction.
  Result<ObjectRef> (*from_ros)(std::span<const std::byte> payload, const MountOf& mount_of, TimePoint came);
};

/// Returns all twins. Of several of one object type the most usual comes first.
[[nodiscard]] std::span<const Twin> twins();

/// Returns the twin by which objects of a type, or of one derived from it, leave as messages.
/// @param message  "sensor_msgs/msg/Range"; empty: the first.
/// @return null if there is none.
[[nodiscard]] const Twin* twin_to_ros(const ObjectType& type, std::string_view message = {});

/// Returns the twin by which messages become objects for a port that takes a type: of that type or of one derived from it.
/// @return null if there is none.
[[nodiscard]] const Twin* twin_from_ros(const ObjectType& type, std::string_view message = {});

/// Returns an object as the message of ROS 2 that says the same, for viewers.
/// @return nothing if there is no such message that is shown.
/// @thread  any.
[[nodiscard]] std::optional<RosMessage> ros_twin(const ObjectRef& object);

}  // namespace orca::ros
