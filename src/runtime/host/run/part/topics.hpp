// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/patterns/dds/ros_topics.hpp"
#include "run/system/system.hpp"

namespace orca::host {

/// The topics of ROS 2 on which ports of this process speak. It outlives them.
///
/// Thread contract: before the components in question run.
class Topics {
 public:
  /// @param graph    name of the graph, for people.
  /// @param process  name of the process, for people.
  Topics(std::string graph, std::string process) : graph_(std::move(graph)), process_(std::move(process)) {}

  /// Connects the ports of a component that have topics. Takes part in the graph of ROS 2 with the first of them.
  /// @errors  those of ros_options_of_environment(), open_ros_topics() and RosTopics::connect().
  Status connect(const graph::ComponentNode& node, System& system);

 private:
  Status open();

  const std::string graph_;
  const std::string process_;
  std::unique_ptr<RosTopics> ros_;  // null: not needed yet
};

}  // namespace orca::host
