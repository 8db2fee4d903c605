// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/placement.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <set>

namespace orca::graph {
namespace {

std::set<std::string> used_processes(const Graph& graph) {
  std::set<std::string> used;
  for (const HardwareNode& node : graph.hardware) used.insert(node.process);
  for (const ComponentNode& node : graph.components) used.insert(node.process);
  return used;
}

// A search for the order in which components come up.
class StartOrder {
 public:
  explicit StartOrder(const Graph& graph) : graph_(graph), waits_for_(graph.components.size()) {
    for (std::size_t i = 0; i < graph.components.size(); ++i) index_.emplace(graph.components[i].name, i);
    for (std::size_t i = 0; i < graph.components.size(); ++i)
      for (const std::string& before : graph.components[i].start_after) wait(i, before);
  }

  std::vector<std::string> run() {
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
    for (std::size_t i = 0; i < waits_for_.size(); ++i)
      if (waits_for_[i] == 0) ready.push(i);
    std::vector<std::string> order;
    while (!ready.empty()) {
      const std::size_t next = ready.top();
      ready.pop();
      order.push_back(graph_.components[next].name);
      for (const std::size_t waiting : followers_[next])
        if (--waits_for_[waiting] == 0) ready.push(waiting);
    }
    return order;
  }

 private:
  // What is not in the graph runs elsewhere, if this is the part of one machine.
  void wait(std::size_t component, const std::string& before) {
    const auto found = index_.find(before);
    if (found == index_.end()) return;
    followers_[found->second].push_back(component);
    ++waits_for_[component];
  }

  const Graph& graph_;
  std::map<std::string, std::size_t> index_;
  std::vector<std::size_t> waits_for_;  // number of components that must come up before
  std::map<std::size_t, std::vector<std::size_t>> followers_;  // components that wait for one
};

// Keeps of the groups what is left of their components.
void reduce_groups(Graph& graph) {
  for (GroupNode& group : graph.groups)
    std::erase_if(group.components,
                  [&](const std::string& name) { return graph.find_component(name) == nullptr; });
  std::erase_if(graph.groups, [](const GroupNode& group) { return group.components.empty(); });
}

// Keeps of a graph what runs in certain processes, and the edges within.
Graph reduced(Graph graph, const std::set<std::string>& processes) {
  const auto elsewhere = [&](const auto& node) { return !processes.contains(node.process); };
  std::erase_if(graph.hardware, elsewhere);
  std::erase_if(graph.components, elsewhere);
  std::erase_if(graph.edges, [&](const Edge& edge) {
    return graph.find_component(edge.from.component) == nullptr ||
           graph.find_component(edge.to.component) == nullptr;
  });
  reduce_groups(graph);
  return graph;
}

}  // namespace

std::vector<ProcessNode> processes_of(const Graph& graph) {
  std::set<std::string> left = used_processes(graph);
  std::vector<ProcessNode> processes;
  for (const ProcessNode& node : graph.processes)
    if (left.erase(node.name) > 0) processes.push_back(node);
  if (left.contains(kMainProcess)) processes.push_back({.name = kMainProcess});
  return processes;
}

bool starts_on_demand(const Graph& graph, const std::string& process) {
  const auto node = std::ranges::find(graph.processes, process, &ProcessNode::name);
  return node != graph.processes.end() && node->on_demand;
}

ProcessPart part_of(const Graph& graph, const std::string& process) {
  ProcessPart part;
  for (const HardwareNode& node : graph.hardware)
    if (node.process == process) part.hardware.push_back(node.name);
  for (const ComponentNode& node : graph.components)
    if (node.process == process) part.components.push_back(node.name);
  const std::set<std::string> inside(part.components.begin(), part.components.end());
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const bool from = inside.contains(graph.edges[i].from.component);
    const bool to = inside.contains(graph.edges[i].to.component);
    if (from && to) part.edges_within.push_back(i);
    if (from && !to) part.edges_out.push_back(i);
    if (!from && to) part.edges_in.push_back(i);
  }
  return part;
}

std::vector<ProcessNode> processes_on(const Graph& graph, const std::string& machine) {
  std::vector<ProcessNode> processes = processes_of(graph);
  std::erase_if(processes, [&](const ProcessNode& node) { return node.machine != machine; });
  return processes;
}

Graph subgraph(const Graph& graph, const std::string& process) { return reduced(graph, {process}); }

bool speaks_dds(const Graph& graph, const std::string& process) {
  const auto is_in = [&](const PortRef& port) {
    const ComponentNode* const node = graph.find_component(port.component);
    return node != nullptr && node->process == process;
  };
  return std::ranges::any_of(graph.edges, [&](const Edge& edge) {
    return edge.link == Link::dds && (is_in(edge.from) || is_in(edge.to));
  });
}

Graph part_on(const Graph& graph, const std::string& machine) {
  std::set<std::string> names;
  for (const ProcessNode& node : processes_on(graph, machine)) names.insert(node.name);
  Graph part = reduced(graph, names);
  std::erase_if(part.ends, [&](const std::string& end) { return part.find_component(end) == nullptr; });
  return part;
}

std::string machine_of(const Graph& graph, const std::string& component) {
  const std::string& process = graph.find_component(component)->process;
  const auto node = std::ranges::find(graph.processes, process, &ProcessNode::name);
  return node == graph.processes.end() ? "" : node->machine;
}

Duration delay_of(const Graph& graph, const Edge& edge) {
  const auto delay_within = [](const auto& nodes, const std::string& name) {
    const auto node = std::ranges::find(nodes, name, [](const auto& one) { return one.name; });
    return node == nodes.end() ? Duration{0} : node->delay;
  };
  const auto delay_between = [&](const auto& nodes, const std::string& from, const std::string& to) {
    return from == to ? Duration{0} : delay_within(nodes, from) + delay_within(nodes, to);
  };
  const auto has_delay = [](const auto& node) { return node.delay > Duration{0}; };
  if (std::ranges::none_of(graph.processes, has_delay) && std::ranges::none_of(graph.machines, has_delay))
    return Duration{0};  // without a search for the ends
  const std::string& from = edge.from.component;
  const std::string& to = edge.to.component;
  return delay_between(graph.processes, graph.find_component(from)->process,
                       graph.find_component(to)->process) +
         delay_between(graph.machines, machine_of(graph, from), machine_of(graph, to));
}

std::vector<std::string> start_order(const Graph& graph) { return StartOrder(graph).run(); }

}  // namespace orca::graph
