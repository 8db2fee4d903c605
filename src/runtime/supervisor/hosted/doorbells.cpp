// SPDX-License-Identifier: LGPL-3.0-or-later
#include "doorbells.hpp"

#include <algorithm>
#include <utility>

namespace orca::supervisor {

Doorbells::Doorbells(const graph::Graph& whole, std::vector<graph::ProcessNode> processes,
                     std::optional<Backend> executor, std::vector<std::string> names, const RunPage& page)
    : nodes_(std::move(processes)), executor_(executor), page_(page), names_(std::move(names)) {
  for (const graph::ComponentNode& node : whole.components) processes_[node.name] = node.process;
}

void Doorbells::add(const graph::ComponentNode& component, std::size_t place) {
  const std::lock_guard lock(mutex_);
  processes_[component.name] = component.process;
  if (names_.size() <= place) names_.resize(place + 1);
  names_[place] = component.name;
}

DoorbellWord& Doorbells::of(const std::string& component) const {
  const std::lock_guard lock(mutex_);
  const auto node = std::ranges::find(nodes_, processes_.at(component), &graph::ProcessNode::name);
  if (executor_.value_or(node->executor) == Backend::fiber)
    return page_.process_doorbell(static_cast<std::size_t>(node - nodes_.begin()));
  return page_.doorbell(static_cast<std::size_t>(std::ranges::find(names_, component) - names_.begin()));
}

std::vector<std::string> Doorbells::names() const {
  const std::lock_guard lock(mutex_);
  return names_;
}

}  // namespace orca::supervisor
