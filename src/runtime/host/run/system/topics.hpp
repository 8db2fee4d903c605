// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/patterns/dds/ros_topics.hpp"
#include "run/component/component_instance.hpp"

namespace orca::host {

/// The topics of ROS 2 on which ports of this process speak. It outlives them.
///
/// Thread contract: before the components in question run.
class Topics {
 public:
  /// Connects the ports of a component that have topics. Takes part in the graph of ROS 2 with the first of them.
  /// @errors  those of ros_options_of_environment(), open_ros_topics() and RosTopics::connect().
  Status connect(const graph::ComponentNode& node, ComponentInstance& component);

 private:
  Status open();

  std::unique_ptr<RosTopics> ros_;  // null: not needed yet
};

}  // namespace orca::host
