// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/graph.hpp"

#include <algorithm>
#include <tuple>

namespace orca::graph {
namespace {

template <class Node>
const Node* find(const std::vector<Node>& nodes, const std::string& wanted) {
  const auto found = std::ranges::find(nodes, wanted, &Node::name);
  return found == nodes.end() ? nullptr : &*found;
}

}  // namespace

bool operator==(const ProcessNode& a, const ProcessNode& b) {
  const auto content = [](const ProcessNode& n) {
    return std::tie(n.name, n.machine, n.executor, n.spin, n.processors, n.priority, n.lock_memory, n.memory,
                    n.restart, n.on_demand, n.idle_time, n.hang_limit);
  };
  return content(a) == content(b);
}

bool operator==(const MachineNode& a, const MachineNode& b) {
  const auto content = [](const MachineNode& n) {
    return std::tie(n.name, n.address, n.interface, n.on_loss, n.loss_limit);
  };
  return content(a) == content(b);
}

bool operator==(const HardwareNode& a, const HardwareNode& b) {
  const auto content = [](const HardwareNode& n) { return std::tie(n.name, n.type, n.process, n.params); };
  return content(a) == content(b);
}

bool operator==(const ComponentNode& a, const ComponentNode& b) {
  const auto content = [](const ComponentNode& n) {
    return std::tie(n.name, n.type, n.hardware, n.process, n.priority, n.autonomous, n.on_demand, n.stay_warm,
                    n.idle_time, n.restore_last, n.may_fail, n.trigger, n.start_after, n.params, n.properties,
                    n.ports);
  };
  return content(a) == content(b);
}

bool operator==(const GroupNode& a, const GroupNode& b) {
  return a.name == b.name && a.components == b.components;
}

bool operator==(const Edge& a, const Edge& b) {
  const auto content = [](const Edge& e) {
    return std::tie(e.from, e.to, e.pattern, e.queue, e.interval, e.late_bound, e.link, e.choice);
  };
  return content(a) == content(b);
}

bool operator==(const PlannedChange& a, const PlannedChange& b) { return a.file == b.file && a.at == b.at; }

const HardwareNode* Graph::find_hardware(const std::string& wanted) const { return find(hardware, wanted); }

const ComponentNode* Graph::find_component(const std::string& wanted) const {
  return find(components, wanted);
}

const GroupNode* Graph::find_group(const std::string& wanted) const { return find(groups, wanted); }

}  // namespace orca::graph
