// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// Ports that speak to ROS 2 over plain DDS: what a port pushes or sends becomes messages of a topic, and messages of a topic arrive
/// at a port as objects. Nodes of ROS 2 need nothing of Orca, and Orca needs nothing of ROS 2.
///
/// It is a part of liborca_dds.so, which a process opens when one of its ports has a topic (open_ros_topics()), and never closes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"

namespace orca {

/// The settings of a process's part in the graph of ROS 2.
struct RosOptions {
  std::uint32_t domain = 0;
  bool only_here = false;  ///< Whether only programs of this machine are spoken to.
};

/// Returns the settings that the environment asks for, as nodes of ROS 2 understand it: ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY and
/// ROS_AUTOMATIC_DISCOVERY_RANGE.
/// @errors  invalid_argument for a value that is none; it says which.
[[nodiscard]] Result<RosOptions> ros_options_of_environment();

/// A topic that a port speaks on.
struct RosTopic {
  std::string name;     ///< "/scan"
  std::string message;  ///< "sensor_msgs/msg/LaserScan"; empty: the usual one for the port's type.
};

/// This process's part in the graph of ROS 2. Each component with a topic is a node there.
///
/// A port that pushes is subscribed to while somebody reads its topic, or always where a later reader wants the latest message, as of a
/// map. Objects with poses also become transforms on /tf and /tf_static. Others are not trusted: messages that are none are
/// dropped, and the first one is reported.
///
/// Thread contract: connect() before the components run. It outlives the ports.
class RosTopics {
 public:
  virtual ~RosTopics() = default;
  /// Lets a PushServer or SendProxy publish on a topic, or a PushProxy or SendServer hear one. The port keeps its end.
  /// @param policy  of the queue where messages arrive.
  /// @errors  invalid_argument if the port's pattern or type has no messages; unavailable if DDS refuses.
  virtual Status connect(Endpoint& port, const RosTopic& topic, const QueuePolicy& policy) = 0;
};

/// Opens the library, if this process has not done so yet, and takes part.
/// @errors  unavailable if there is no such library, or if DDS does not start.
[[nodiscard]] Result<std::unique_ptr<RosTopics>> open_ros_topics(const RosOptions& options);

/// The result of the library's function.
using MadeRosTopics = std::optional<Result<std::unique_ptr<RosTopics>>>;
/// The library exports it as orca_make_ros_topics.
using MakeRosTopics = void(const RosOptions& options, MadeRosTopics& made);

}  // namespace orca
