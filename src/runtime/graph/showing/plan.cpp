// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/plan.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "attributes.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "renewal.hpp"

namespace orca::graph {
namespace {

// Returns whether it says what a run goes over to later; one that is under way has taken note of that already.
bool is_planned(const FieldChange& change) { return change.field.starts_with(kChangeField); }

std::optional<Edge> find_edge(const Graph& graph, const std::string& name) {
  const auto edge = std::ranges::find(graph.edges, name, &Edge::name);
  return edge == graph.edges.end() ? std::nullopt : std::optional(*edge);
}

bool chooses(const ComponentNode& node) {
  return std::ranges::any_of(node.ports, [](const auto& port) { return !port.second.candidates.empty(); });
}

// Makes the plan, one difference after the other.
class PlanMaker {
 public:
  PlanMaker(const Way& way, const std::vector<Change>& changes) : way_(way) {
    if (way.means.renews_processes) plan_.renewed = processes_to_renew(way, changes);
    can_renew_ = std::ranges::none_of(plan_.renewed, [&](const std::string& process) {
      return starts_on_demand(way.running, process) || starts_on_demand(way.wanted, process);
    });
  }

  void add(const Change& change) {
    switch (change.part) {
      case Change::Part::group: return add_lines(change, Effort::none);
      case Change::Part::connection: return add_lines(change, effort_of_connection(change));
      case Change::Part::component: return add_component(change);
      case Change::Part::hardware: return add_lines(change, effort_of_hardware(change));
      case Change::Part::process: return add_lines(change, effort_of_process(change));
      case Change::Part::graph:
      case Change::Part::machine: return add_lines(change, Effort::restart);
    }
  }

  GraphPlan take() {
    const bool is_possible =
        std::ranges::none_of(plan_.lines, [](const auto& line) { return line.effort == Effort::restart; });
    if (is_possible && !keeps_choices(way_))
      plan_.lines.push_back({"~ ports that choose between several servers", {}, Effort::restart});
    return std::move(plan_);
  }

 private:
  [[nodiscard]] bool is_renewed(const std::string& process) const { return plan_.renewed.contains(process); }
  // Returns whether a component is, or will be, in a process that begins anew.
  [[nodiscard]] bool is_renewed(const ComponentNode* before, const ComponentNode* after) const {
    return (before != nullptr && is_renewed(before->process)) ||
           (after != nullptr && is_renewed(after->process));
  }
  [[nodiscard]] Effort renewal() const { return can_renew_ ? Effort::renew : Effort::restart; }

  void add_lines(const Change& change, Effort effort) {
    for (const FieldChange& field : change.fields)
      plan_.lines.push_back({title(change), field, is_planned(field) ? Effort::none : effort});
    if (change.fields.empty()) plan_.lines.push_back({title(change), {}, effort});
  }

  void add_component(const Change& change) {
    const ComponentNode* const before = way_.running.find_component(change.name);
    const ComponentNode* const after = way_.wanted.find_component(change.name);
    if (is_renewed(before, after)) return add_lines(change, renewal());
    if (change.kind != Change::Kind::changed) return add_lines(change, come_or_go(before, after));
    change_component(change, *after);
  }

  // Plans the change of a component that both graphs have, and whose process stays.
  void change_component(const Change& change, const ComponentNode& wanted) {
    const auto contract = way_.contracts.find(change.name);
    const bool sets = only_sets(change, contract == way_.contracts.end() ? nullptr : &contract->second);
    const Effort effort = sets ? Effort::set : wanted.hardware.empty() ? Effort::exchange : Effort::restart;
    Params settings;
    bool changes_code = false;
    for (const FieldChange& field : change.fields) {
      const Effort other = field.field == "start_after" ? Effort::none : Effort::restart;
      plan_.lines.push_back({title(change), field, concerns_code(field) ? effort : other});
      const std::string param = param_of(field);
      if (!param.empty() && effort == Effort::set) settings[param] = wanted.params.at(param);
      changes_code = changes_code || (concerns_code(field) && effort == Effort::exchange);
    }
    if (!settings.empty()) plan_.settings[wanted.name] = std::move(settings);
    if (changes_code) plan_.exchanges.push_back({wanted.name, wanted.type, wanted.params});
  }

  // A component can come or go while the others run if its own process runs all the time, and it chooses nothing.
  Effort come_or_go(const ComponentNode* before, const ComponentNode* after) {
    const ComponentNode& node = before != nullptr ? *before : *after;
    const std::vector<ProcessNode> processes = processes_of(way_.running);
    const bool is_there = std::ranges::find(processes, node.process, &ProcessNode::name) != processes.end();
    if (!is_there || !stays(node.process) || way_.running.machines.size() > 1 || node.on_demand ||
        chooses(node))
      return Effort::restart;
    if (after != nullptr) {
      plan_.added.push_back(node);
    } else {
      plan_.removed.push_back(node.name);
    }
    return after != nullptr ? Effort::add : Effort::remove;
  }

  // Returns whether a process runs all the time, before and after.
  [[nodiscard]] bool stays(const std::string& process) const {
    if (starts_on_demand(way_.running, process)) return false;
    const std::vector<ProcessNode> after = processes_of(way_.wanted);
    return std::ranges::find(after, process, &ProcessNode::name) != after.end();
  }

  [[nodiscard]] Effort effort_of_hardware(const Change& change) const {
    for (const Graph* const graph : {&way_.running, &way_.wanted})
      if (const HardwareNode* const node = graph->find_hardware(change.name))
        if (!is_renewed(node->process)) return Effort::restart;
    return renewal();
  }

  [[nodiscard]] Effort effort_of_process(const Change& change) const {
    if (is_renewed(change.name)) return renewal();
    const std::vector<ProcessNode> running = processes_of(way_.running);
    const bool is_used = std::ranges::find(running, change.name, &ProcessNode::name) != running.end();
    return is_used ? Effort::restart : Effort::none;
  }

  // A connection is made and removed by those of its ends that stay; those that begin anew have it from the start.
  Effort effort_of_connection(const Change& change) {
    GraphPlan::Rewiring rewiring{find_edge(way_.running, change.name), find_edge(way_.wanted, change.name)};
    bool is_renewed_at_all_ends = true;
    for (const std::optional<Edge>& edge : {rewiring.before, rewiring.after}) {
      if (!edge) continue;
      if (!is_plain(*edge)) return Effort::restart;
      for (const PortRef* const end : {&edge->from, &edge->to}) {
        const bool begins_anew = is_renewed(way_.running.find_component(end->component),
                                            way_.wanted.find_component(end->component));
        is_renewed_at_all_ends = is_renewed_at_all_ends && begins_anew;
        if (!begins_anew && !can_rewire_at(*end, *edge)) return Effort::restart;
      }
    }
    if (is_renewed_at_all_ends) return renewal();
    plan_.connections.push_back(std::move(rewiring));
    return Effort::rewire;
  }

  // Returns whether the component stays in its process, or comes or goes there.
  [[nodiscard]] bool can_rewire_at(const PortRef& end, const Edge& edge) const {
    const ComponentNode* const before = way_.running.find_component(end.component);
    const ComponentNode* const after = way_.wanted.find_component(end.component);
    if (edge.link == Link::dds) return false;
    if (before == nullptr || after == nullptr) return true;
    return before->process == after->process && !starts_on_demand(way_.running, before->process);
  }

  const Way& way_;
  bool can_renew_ = true;
  GraphPlan plan_;
};

// Sorts what comes as it starts, and what goes the other way round.
void sort_by_start(const Graph& running, const Graph& wanted, GraphPlan& plan) {
  const auto place = [](const std::vector<std::string>& order) {
    return [&order](const std::string& name) { return std::ranges::find(order, name) - order.begin(); };
  };
  const std::vector<std::string> start = start_order(wanted);
  const std::vector<std::string> present = start_order(running);
  std::ranges::sort(plan.added, {}, [&](const ComponentNode& node) { return place(start)(node.name); });
  std::ranges::sort(plan.removed, std::greater<>(), place(present));
}

}  // namespace

const char* to_string(Effort effort) {
  switch (effort) {
    case Effort::none: return "at once; nothing runs otherwise";
    case Effort::set: return "between two laps; nothing stops";
    case Effort::rewire: return "between two laps; no other connection notices";
    case Effort::add: return "comes up beside the others; nothing stops";
    case Effort::remove: return "ends when its connections are gone; nothing else stops";
    case Effort::exchange: return "tried for 1 s, then exchanged between two laps; nothing stops";
    case Effort::renew: return "its process is started again; what runs there stops meanwhile";
    case Effort::restart: return "only when the system is started again";
  }
  return "?";
}

std::vector<GraphPlan::Rewiring> GraphPlan::connections_of(bool newcomers) const {
  std::vector<Rewiring> chosen = connections;
  std::erase_if(chosen, [&](const Rewiring& one) {
    const std::string& client = (one.after ? *one.after : *one.before).client().component;
    return (std::ranges::find(added, client, &ComponentNode::name) != added.end()) != newcomers;
  });
  return chosen;
}

bool GraphPlan::is_possible() const {
  return std::ranges::none_of(lines, [](const Line& line) { return line.effort == Effort::restart; });
}

GraphPlan plan_of(const Graph& running, const Graph& wanted, const std::map<std::string, Contract>& contracts,
                  const PlanMeans& means) {
  const Way way{running, wanted, contracts, means};
  const std::vector<Change> changes = diff(running, wanted);
  PlanMaker maker(way, changes);
  for (const Change& change : changes) maker.add(change);
  GraphPlan plan = maker.take();
  sort_by_start(running, wanted, plan);
  return plan;
}

std::vector<GraphPlan::Rewiring> reversed(std::vector<GraphPlan::Rewiring> connections) {
  for (GraphPlan::Rewiring& one : connections) std::swap(one.before, one.after);
  return connections;
}

void put(const Edge& edge, bool is_there, std::vector<Edge>& edges) {
  const auto known = std::ranges::find(edges, edge.name(), &Edge::name);
  if (known != edges.end() && is_there) {
    *known = edge;
  } else if (known != edges.end()) {
    edges.erase(known);
  } else if (is_there) {
    edges.push_back(edge);
  }
}

void go_over(Graph& graph, const Graph& wanted) {
  const auto is_known = [&graph](const ComponentNode& node) {
    return graph.find_component(node.name) != nullptr;
  };
  const bool has_same =
      graph.components.size() == wanted.components.size() && std::ranges::all_of(wanted.components, is_known);
  if (has_same) {
    for (ComponentNode& node : graph.components) node = *wanted.find_component(node.name);
  } else {
    graph.components = wanted.components;
  }
  graph.processes = wanted.processes;
  graph.hardware = wanted.hardware;
  graph.groups = wanted.groups;
  graph.edges = wanted.edges;
  graph.team.ports = wanted.team.ports;
}

std::string obstacles_of(const GraphPlan& plan) {
  constexpr std::size_t kShown = 4;
  std::vector<std::string> all;
  for (const GraphPlan::Line& line : plan.lines)
    if (line.effort == Effort::restart)
      all.push_back(line.part + (line.change.field.empty() ? "" : ": " + line.change.field));
  const std::size_t others = all.size() - std::min(all.size(), kShown);
  all.resize(all.size() - others);
  return "the system has to be started again for " + joined(all, ", ") +
         (others > 0 ? " and " + std::to_string(others) + " more changes (orcactl diff shows them)" : "");
}

}  // namespace orca::graph
