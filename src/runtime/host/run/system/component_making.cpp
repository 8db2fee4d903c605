// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_making.hpp"

#include <algorithm>
#include <optional>

#include "orca/graph/placement.hpp"

namespace orca::host {

ComponentSettings settings_of(const graph::ComponentNode& node, const std::vector<PlannedFailure>& failures) {
  ComponentSettings settings;
  settings.name = node.name;
  settings.priority = node.priority;
  settings.autonomous = node.autonomous;
  settings.watchable = node.watchable;
  settings.trigger = node.trigger;
  settings.takes = node.takes;
  settings.on_demand = node.on_demand;
  settings.stay_warm = node.stay_warm;
  settings.idle_time = node.idle_time;
  settings.keeps_state = node.restore_last;
  settings.may_set = node.may_set;
  settings.may_suspend = node.may_suspend;
  settings.params = node.params;
  for (const auto& [port, setting] : node.ports)
    if (!setting.alias.empty()) settings.port_names[port] = setting.alias;
  for (const PlannedFailure& failure : failures)
    if (failure.component == node.name) settings.failure = failure;
  return settings;
}

Cores* cores_of(const graph::Graph& graph, const std::string& process, std::map<std::string, Cores>& cores) {
  const auto node = std::ranges::find(graph.processes, process, &graph::ProcessNode::name);
  if (node == graph.processes.end() || node->cores == 0) return nullptr;
  return &cores.try_emplace(process, node->cores).first->second;
}

Status declare(const graph::Graph& graph, const graph::ComponentNode& node, ComponentInstance& instance,
               PluginCatalogue& catalogue) {
  std::optional<graph::HardwareUse> use;
  if (const graph::HardwareNode* hardware = graph.find_hardware(node.hardware))
    use = {hardware->name, hardware->type, hardware->params};
  const Result<Contract> contract = catalogue.component(node.type, use ? &*use : nullptr);
  if (!contract) return contract.error();
  instance.declare(*contract);
  return ok();
}

LocalLinks links_of(const graph::Graph& graph, const graph::Edge& edge, RunContext& run) {
  if (!run.executive.is_virtual()) return {};
  return {run.courier, graph::delay_of(graph, edge)};
}

QueuePolicy policy_of(const graph::Edge& edge) {
  QueuePolicy policy = edge.queue;
  policy.min_interval = edge.interval;
  return policy;
}

Status connect(const graph::Graph& graph, const std::function<ComponentInstance*(const std::string&)>& find,
               const std::function<LocalLinks(const graph::Edge&)>& links_of) {
  for (const graph::Edge& edge : graph.edges) {
    Endpoint* const from = find(edge.from.component)->endpoint(edge.from.port);
    Endpoint* const to = find(edge.to.component)->endpoint(edge.to.port);
    if (from == nullptr || to == nullptr)
      return fail(Code::internal, "a port that was there when the graph was checked is not there now",
                  edge.position.text());
    Endpoint& client = edge.pattern == Pattern::push ? *to : *from;
    prepare_choice(edge, client);
    const Status connected = links_of(edge).connect(*from, *to, policy_of(edge));
    if (!connected.ok()) return connected;
    take_first_choice(edge, client);
  }
  return ok();
}

void prepare_choice(const graph::Edge& edge, Endpoint& client) {
  auto* const port = dynamic_cast<MovablePort*>(&client);
  if (edge.choice > 0 && port != nullptr && !port->can_move()) port->allow_moves();
}

void take_first_choice(const graph::Edge& edge, Endpoint& client) {
  auto* const port = dynamic_cast<MovablePort*>(&client);
  if (edge.choice == 1 && port != nullptr) (void)port->move_to(edge.server().text());
}

bool wait_until_holds(Executive& executive, Event& changed, TimePoint deadline,
                      const std::function<bool()>& done) {
  while (!done()) {
    if (executive.now() >= deadline) return false;
    changed.wait_until(deadline);
  }
  return true;
}

}  // namespace orca::host
