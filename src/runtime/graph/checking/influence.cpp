// SPDX-License-Identifier: LGPL-3.0-or-later
#include "influence.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"

namespace orca::graph {
namespace {

class Influence {
 public:
  Influence(const Model& model, const Graph& graph, Report& report)
      : model_(model), graph_(graph), report_(report) {
    for (const Edge& edge : graph.edges) {
      connected_[edge.from.component].insert(edge.from.port);
      connected_[edge.to.component].insert(edge.to.port);
    }
  }

  void check() {
    std::set<std::string> bound;
    for (const CheckedComponent& component : model_.components) bound.insert(component.value.hardware);
    for (const CheckedHardware& hardware : model_.hardware) {
      if (bound.contains(hardware.value.name)) continue;
      report_.warning(codes::kUnusedHardware, hardware.value.position,
                      "hardware " + in_quotes(hardware.value.name) +
                          ": no component is bound to it, so nothing comes of it");
    }
    for (const CheckedComponent& component : model_.components) check(component);
  }

 private:
  void check(const CheckedComponent& component) {
    if (component.contract->ports.empty() || works_by_itself(component.value)) return;
    const std::set<std::string>& connected = connected_[component.value.name];
    if (connected.empty()) return warn(component, "it is connected to nothing");
    if (!only_listens(*component.contract, connected)) return check_trigger(component, connected);
    std::vector<std::string> unused;
    for (const PortContract& port : component.contract->ports)
      if (is_output(port)) unused.push_back(port.name);
    if (!unused.empty()) warn(component, "nobody listens to what it pushes: " + listed(unused));
  }

  [[nodiscard]] bool works_by_itself(const ComponentNode& node) const {
    return node.autonomous.value_or(false) || std::ranges::find(graph_.ends, node.name) != graph_.ends.end();
  }

  static bool is_output(const PortContract& port) {
    return port.pattern == Pattern::push && port.role == Role::server;
  }

  // Returns whether only PushProxies are connected.
  static bool only_listens(const Contract& contract, const std::set<std::string>& connected) {
    return std::ranges::all_of(contract.ports, [&](const PortContract& port) {
      return !connected.contains(port.name) || (port.pattern == Pattern::push && port.role == Role::proxy);
    });
  }

  void warn(const CheckedComponent& component, const std::string& reason) {
    report_.warning(codes::kNoInfluence, component.value.position,
                    "component " + in_quotes(component.value.name) + ": " + reason +
                        "; if it works all the same, say so with autonomous=\"true\"");
  }

  void check_trigger(const CheckedComponent& component, const std::set<std::string>& connected) {
    const Trigger& trigger = component.value.trigger.value_or(component.contract->default_trigger);
    if (!trigger.waits_for_ports() || trigger.period > Duration{0}) return;
    std::vector<std::string> silent;
    for (const std::string& name : trigger.ports)
      if (const std::string port = name_in_graph(component, name); !connected.contains(port))
        silent.push_back(in_quotes(port));
    if (silent.empty() || (!trigger.needs_all_ports() && silent.size() < trigger.ports.size())) return;
    report_.warning(codes::kNeverTriggered, component.value.position,
                    "component " + in_quotes(component.value.name) + ": its laps start on port " +
                        listed(silent) + ", to which nothing is connected, so it never does one; " +
                        "connect it, or set period or on");
  }

  // Returns the graph's name of a port; the author's own trigger uses the author's name.
  static std::string name_in_graph(const CheckedComponent& component, const std::string& port) {
    const auto renamed = component.renamed.find(port);
    return renamed == component.renamed.end() ? port : renamed->second.name;
  }

  const Model& model_;
  const Graph& graph_;
  Report& report_;
  std::map<std::string, std::set<std::string>> connected_;  // ports, by component
};

}  // namespace

void check_influence(const Model& model, const Graph& graph, Report& report) {
  Influence(model, graph, report).check();
}

}  // namespace orca::graph
