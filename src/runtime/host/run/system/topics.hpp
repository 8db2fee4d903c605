// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "run/component/component_instance.hpp"

namespace orca {
class RosTopics;
class TeamTopics;
}  // namespace orca

namespace orca::host {

/// The topics of ROS 2 on which ports of this process speak, and what they say to the team. It outlives them.
///
/// Thread contract: one thread, before the components in question run.
class Topics {
 public:
  /// @param graph  outlives the object.
  /// @param run    the same in all processes of a run, and in no other run.
  Topics(const graph::Graph& graph, std::string run);
  ~Topics();
  Topics(const Topics&) = delete;
  Topics& operator=(const Topics&) = delete;

  /// Connects the ports of a component that have topics, or are in the team. Takes part in the graph of ROS 2 with the first topic, and
  /// in the team with the first of its ports. Without a team its ports are connected to nothing.
  /// @errors  internal if a port is missing; those of ros_options_of_environment(), own_address(), open_ros_topics(), open_team_topics()
  ///          and connect() of both.
  Status connect(const graph::ComponentNode& node, ComponentInstance& component);

 private:
  Status open_ros();
  Status open_team();
  Status connect(Endpoint& port, const graph::PortSetting& setting);

  const graph::Graph& graph_;
  const std::string run_;
  std::unique_ptr<RosTopics> ros_;    // null: not needed yet
  std::unique_ptr<TeamTopics> team_;  // the same
};

/// Connects the proxies of a component that have topics, or are in the team, where nobody speaks on them: in virtual time, and where
/// code is tried out. Nothing comes, and whatever is sent goes nowhere.
/// @errors  internal if a port is missing.
Status connect_silence(const graph::ComponentNode& node, ComponentInstance& component);

}  // namespace orca::host
