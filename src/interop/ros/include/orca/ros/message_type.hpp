// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/idl/object_type.hpp"

namespace orca::ros {

/// A message type as ROS 2 names it, with its definition and those of all that it holds: what a file or a server gives to
/// readers as a schema of the encoding "ros2msg".
struct MessageType {
  std::string name;        ///< "sensor_msgs/msg/LaserScan"
  std::string definition;  ///< Fields, one per line; what they hold follows after lines of '='.
  std::string hash{};  ///< RIHS01 of the type, 64 digits, by which tools of ROS 2 know it; empty: not known.
};

/// Returns an object type of Orca as a message type of the package `orca`: the same fields in the same order, so that the bytes of
/// ObjectType::serialize() are a message of it. Parts are types of the package `orca_values`. Units are comments.
/// @thread  any.
[[nodiscard]] MessageType message_type_of(const ObjectType& type);

/// Returns a message type of ROS 2 itself, as far as objects of Orca have twins of it.
/// @param name  "sensor_msgs/msg/LaserScan"
/// @return nothing for another name.
/// @thread  any.
[[nodiscard]] std::optional<MessageType> standard_message_type(std::string_view name);

/// Returns the name of a message type in DDS: "sensor_msgs::msg::dds_::LaserScan_" of "sensor_msgs/msg/LaserScan".
/// @thread  any.
[[nodiscard]] std::string dds_type_name(std::string_view message);

}  // namespace orca::ros
