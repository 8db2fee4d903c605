// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/robot_finder.hpp"

#include <set>

namespace orca::host {
namespace {

using Owners = std::map<std::string, std::string>;  // robot by component; empty: disputed
using Neighbours = std::map<std::string, std::set<std::string>>;

Neighbours neighbours_of(const graph::Graph& graph) {
  Neighbours neighbours;
  for (const graph::Edge& edge : graph.edges) {
    neighbours[edge.from.component].insert(edge.to.component);
    neighbours[edge.to.component].insert(edge.from.component);
  }
  return neighbours;
}

// Returns the components that wrap a robot's hardware.
Owners servers_of(const graph::Graph& graph, const std::map<std::string, std::string>& robot_of_hardware) {
  Owners servers;
  for (const graph::ComponentNode& component : graph.components)
    if (const auto robot = robot_of_hardware.find(component.hardware); robot != robot_of_hardware.end())
      servers[component.name] = robot->second;
  return servers;
}

// Returns the components one connection beyond `ring` that are in nobody's hands yet.
Owners next_ring(const Owners& ring, const Owners& known, const Neighbours& neighbours) {
  Owners next;
  for (const auto& [component, robot] : ring) {
    const auto around = neighbours.find(component);
    if (robot.empty() || around == neighbours.end()) continue;
    for (const std::string& neighbour : around->second) {
      if (known.contains(neighbour)) continue;
      const auto [claim, is_first] = next.emplace(neighbour, robot);
      if (!is_first && claim->second != robot) claim->second.clear();
    }
  }
  return next;
}

}  // namespace

RobotNames find_robots(const graph::Graph& graph,
                       const std::map<std::string, std::string>& robot_of_hardware) {
  RobotNames names;
  for (const graph::HardwareNode& hardware : graph.hardware)
    if (const auto robot = robot_of_hardware.find(hardware.name); robot != robot_of_hardware.end())
      names.robots.push_back(robot->second);
  const Neighbours neighbours = neighbours_of(graph);
  Owners owners = servers_of(graph, robot_of_hardware);
  for (Owners ring = owners; !ring.empty();) {
    ring = next_ring(ring, owners, neighbours);
    owners.insert(ring.begin(), ring.end());
  }
  std::erase_if(owners, [](const auto& owner) { return owner.second.empty(); });
  names.by_component = std::move(owners);
  return names;
}

}  // namespace orca::host
