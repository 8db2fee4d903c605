// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "orca/idl/object_type.hpp"

namespace orca::view {

/// What a viewer of the Foxglove protocol can subscribe to. A plain value.
struct Channel {
  enum class Kind {
    object,  ///< The objects of a port as they are.
    twin,    ///< The objects of a port as messages of a type that ROS 2 itself has.
    frames,  ///< Where the frames of robots and sensors are, from all ports that say it.
    log,     ///< The system's log.
    text     ///< One text that does not change, such as a robot's file.
  };
  std::uint32_t id = 0;
  Kind kind = Kind::object;
  std::string topic;
  std::vector<std::string> ports{};  ///< One, but for frames.
  std::string type;                  ///< Of messages: "sensor_msgs/msg/LaserScan".
  std::string definition;            ///< In the form "ros2msg".
  std::string text{};                ///< Of a channel with one text.
};

/// Returns the channels of a system.
/// @param ports  the answer to the command ports, as JSON.
/// @throws json::exception if it is none.
[[nodiscard]] std::vector<Channel> channels_of(const nlohmann::json& ports);

/// Returns the message that declares channels.
[[nodiscard]] nlohmann::json advertisement_of(const std::vector<Channel>& channels);

/// Returns the message that says which components publish and take what, for a picture of the system.
/// @param ports  as above.
[[nodiscard]] nlohmann::json connection_graph_of(const nlohmann::json& ports);

/// Returns the only port whose name ends so, such as ".GotoCoordinateSend"; empty: there is none, or more than one.
[[nodiscard]] std::string port_with_end(const nlohmann::json& ports, const std::string& end);

}  // namespace orca::view
