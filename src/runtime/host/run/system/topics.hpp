// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "run/component/component_instance.hpp"

namespace orca {
class RosTopics;
}

namespace orca::host {

/// The topics of ROS 2 on which ports of this process speak. It outlives them.
///
/// Thread contract: one thread, before the components in question run.
class Topics {
 public:
  Topics();
  ~Topics();
  Topics(const Topics&) = delete;
  Topics& operator=(const Topics&) = delete;

  /// Connects the ports of a component that have topics. Takes part in the graph of ROS 2 with the first of them.
  /// @errors  internal if a port is missing; those of ros_options_of_environment(), open_ros_topics() and RosTopics::connect().
  Status connect(const graph::ComponentNode& node, ComponentInstance& component);

 private:
  Status open();

  std::unique_ptr<RosTopics> ros_;  // null: not needed yet
};

/// Connects the proxies of a component that have topics where nobody speaks on them: in virtual time, and where code is
/// tried out. Nothing comes, and whatever is sent goes nowhere.
/// @errors  internal if a port is missing.
Status connect_silence(const graph::ComponentNode& node, ComponentInstance& component);

}  // namespace orca::host
