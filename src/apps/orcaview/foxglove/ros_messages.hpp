// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <string_view>

#include "orca/base/result.hpp"

namespace orca::view {

/// What a viewer publishes for a robot, as an object of Orca. A plain value.
struct Published {
  std::string port_end;  ///< End of the name of the port that takes it: ".GotoCoordinateSend".
  std::string xml;       ///< The object's text form.
};

/// Reads a message of ROS 2 that a viewer publishes, by the twins that topics have (orca/ros/twin.hpp): geometry_msgs/msg/PoseStamped is a goal, PoseWithCovarianceStamped says where the
/// robot is, Twist and TwistStamped drive it. "geometry_msgs/Twist" means the same.
/// @param encoding  "cdr" or "json".
/// @errors  unimplemented for another type or encoding; data_loss if the bytes are no such message, a number in it is none, or a place
///          is in another frame than the map's.
[[nodiscard]] Result<Published> read_ros_message(std::string_view type, std::string_view encoding,
                                                 const std::string& bytes);

}  // namespace orca::view
