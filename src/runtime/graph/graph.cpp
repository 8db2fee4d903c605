// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/graph.hpp"

#include <algorithm>

namespace orca::graph {
namespace {

template <class Node>
const Node* find(const std::vector<Node>& nodes, const std::string& wanted) {
  const auto found = std::ranges::find(nodes, wanted, &Node::name);
  return found == nodes.end() ? nullptr : &*found;
}

}  // namespace

const HardwareNode* Graph::find_hardware(const std::string& wanted) const { return find(hardware, wanted); }

const ComponentNode* Graph::find_component(const std::string& wanted) const {
  return find(components, wanted);
}

const GroupNode* Graph::find_group(const std::string& wanted) const { return find(groups, wanted); }

PortSetting setting_of(const ComponentNode& node, const std::string& port) {
  for (const auto& [name, setting] : node.ports)
    if ((setting.alias.empty() ? name : setting.alias) == port) return setting;
  return {};
}

}  // namespace orca::graph
