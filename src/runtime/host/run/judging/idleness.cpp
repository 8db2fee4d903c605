// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/idleness.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"

namespace orca::host {
namespace {

// Returns whether a port of the component has taken an object or a question.
bool has_served(const std::string& component, const RunCounters& counters) {
  return std::ranges::any_of(counters.servers, [&](const auto& server) {
    const auto& [port, counted] = server;
    return port.substr(0, port.rfind('.')) == component && counted.accepted > 0;
  });
}

// Returns whether others only send to the component or ask it.
bool only_serves(const std::string& component, const graph::Graph& graph) {
  bool serves = false;
  for (const graph::Edge& edge : graph.edges) {
    const bool serves_here = edge.to.component == component && edge.pattern != Pattern::push;
    if (!serves_here && (edge.from.component == component || edge.to.component == component)) return false;
    serves = serves || serves_here;
  }
  return serves;
}

// Returns whether others may choose the component, and nobody depends on it alone: it may never have been chosen.
bool only_stands_by(const std::string& component, const graph::Graph& graph) {
  bool stands_by = false;
  for (const graph::Edge& edge : graph.edges) {
    if (edge.server().component != component) continue;
    if (edge.choice == 0) return false;
    stands_by = true;
  }
  return stands_by;
}

// Returns the components that could have subscribed to this one.
std::vector<std::string> listeners_of(const std::string& component, const graph::Graph& graph) {
  std::vector<std::string> listeners;
  for (const graph::Edge& edge : graph.edges) {
    const bool listens = edge.pattern == Pattern::push && edge.from.component == component;
    if (listens && std::ranges::find(listeners, edge.to.component) == listeners.end())
      listeners.push_back(edge.to.component);
  }
  return listeners;
}

// Returns whether the component sends, or is sent something: it may have a reason of its own to work.
bool may_work_by_itself(const std::string& component, const graph::Graph& graph) {
  return std::ranges::any_of(graph.edges, [&](const graph::Edge& edge) {
    return edge.pattern == Pattern::send &&
           (edge.from.component == component || edge.to.component == component);
  });
}

std::string reason(const graph::ComponentNode& node, const graph::Graph& graph) {
  if (node.autonomous.value_or(false)) return "it did not get beyond its start";
  const std::vector<std::string> listeners = listeners_of(node.name, graph);
  if (!listeners.empty()) return "none of those that it is connected to has subscribed: " + listed(listeners);
  if (may_work_by_itself(node.name, graph))
    return "nobody listens to it, and neither its parameters nor what was sent to it made it work";
  return "nobody listens to it, and it works by itself only with autonomous=\"true\" in the graph";
}

bool nothing_moved(const RunCounters& counters) {
  const auto carried = [](const auto& edge) { return edge.counters.delivered > 0; };
  const auto took = [](const auto& server) { return server.second.accepted > 0; };
  return std::ranges::none_of(counters.edges, carried) && std::ranges::none_of(counters.servers, took);
}

}  // namespace

std::vector<Idleness> find_idleness(const graph::Graph& graph, const Reports& reports,
                                    const RunCounters& counters) {
  std::vector<Idleness> found;
  for (const graph::ComponentNode& node : graph.components) {
    const ComponentReport report = reports(node.name);
    const bool did_something = report.has_worked || report.has_failed || has_served(node.name, counters);
    const bool on_demand = node.on_demand || graph::starts_on_demand(graph, node.process);
    if (did_something || on_demand || node.watchable || only_serves(node.name, graph) ||
        only_stands_by(node.name, graph))
      continue;
    found.push_back({node.name, "has never worked in this run: " + reason(node, graph)});
  }
  if (!graph.edges.empty() && nothing_moved(counters))
    found.push_back({"", "no connection has carried anything in this run"});
  return found;
}

}  // namespace orca::host
