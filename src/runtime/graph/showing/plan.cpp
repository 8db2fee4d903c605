// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/plan.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"

namespace orca::graph {
namespace {

constexpr std::string_view kParam = "param ";

bool is_param(const FieldChange& change) { return change.field.starts_with(kParam); }

// Returns whether it says what a run goes over to later; one that is under way has taken note of that already.
bool is_planned(const FieldChange& change) { return change.field.starts_with(kChangeField); }

std::string param_of(const FieldChange& change) { return change.field.substr(kParam.size()); }

bool can_change(const FieldChange& change, const Contract* contract) {
  const ParamContract* const param = contract == nullptr ? nullptr : contract->param(param_of(change));
  return param != nullptr && !param->fixed;
}

// Returns what it takes to change the code and the parameters of a component.
Effort effort_of(const Change& change, const ComponentNode& wanted, const Contract* contract) {
  const bool only_sets = std::ranges::all_of(change.fields, [&](const FieldChange& field) {
    return field.field != "type" && (!is_param(field) || can_change(field, contract));
  });
  if (only_sets) return Effort::set;
  return wanted.hardware.empty() ? Effort::exchange : Effort::restart;
}

// Plans the change of a component that both graphs have.
void add_component(const Change& change, const ComponentNode& wanted, const Contract* contract,
                   GraphPlan& plan) {
  const Effort effort = effort_of(change, wanted, contract);
  Params settings;
  bool changes_code = false;
  for (const FieldChange& field : change.fields) {
    const bool is_known = is_param(field) || field.field == "type";
    const Effort other = field.field == "start_after" ? Effort::none : Effort::restart;
    plan.lines.push_back({title(change), field, is_known ? effort : other});
    if (is_param(field) && effort == Effort::set)
      settings[param_of(field)] = wanted.params.at(param_of(field));
    changes_code = changes_code || (is_known && effort == Effort::exchange);
  }
  if (!settings.empty()) plan.settings[wanted.name] = std::move(settings);
  if (changes_code) plan.exchanges.push_back({wanted.name, wanted.type, wanted.params});
}

std::optional<Edge> find_edge(const Graph& graph, const std::string& name) {
  const auto edge = std::ranges::find(graph.edges, name, &Edge::name);
  return edge == graph.edges.end() ? std::nullopt : std::optional(*edge);
}

// Returns whether a connection can be made and removed while its ends run: they are in the same process before and after, or
// come or go, that process runs all the time, and the port uses no other server in its place.
bool can_rewire(const Edge& edge, const Graph& running, const Graph& wanted) {
  const auto stays = [&](const PortRef& port) {
    const ComponentNode* const before = running.find_component(port.component);
    const ComponentNode* const after = wanted.find_component(port.component);
    if (before == nullptr || after == nullptr) return true;
    return before->process == after->process && !starts_on_demand(running, before->process);
  };
  return edge.choice == 0 && edge.link != Link::dds && stays(edge.from) && stays(edge.to);
}

// Returns whether a component can come or go while the others run: there are the same processes before and after, its own runs
// all the time, and it chooses nothing.
bool can_come_or_go(const ComponentNode& node, const Graph& running, const Graph& wanted) {
  const std::vector<ProcessNode> before = processes_of(running);
  const bool are_same =
      std::ranges::equal(before, processes_of(wanted), {}, &ProcessNode::name, &ProcessNode::name);
  const bool is_there = std::ranges::find(before, node.process, &ProcessNode::name) != before.end();
  const bool chooses =
      std::ranges::any_of(node.ports, [](const auto& port) { return !port.second.candidates.empty(); });
  return are_same && is_there && running.machines.size() < 2 && !node.on_demand &&
         !starts_on_demand(running, node.process) && !chooses;
}

Effort add_or_remove(const Change& change, const Graph& running, const Graph& wanted, GraphPlan& plan) {
  const bool comes = change.kind == Change::Kind::added;
  const ComponentNode& node = *(comes ? wanted : running).find_component(change.name);
  if (!can_come_or_go(node, running, wanted)) return Effort::restart;
  if (comes) {
    plan.added.push_back(node);
  } else {
    plan.removed.push_back(node.name);
  }
  return comes ? Effort::add : Effort::remove;
}

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

Effort add_connection(const Change& change, const Graph& running, const Graph& wanted, GraphPlan& plan) {
  GraphPlan::Rewiring rewiring{find_edge(running, change.name), find_edge(wanted, change.name)};
  for (const std::optional<Edge>& edge : {rewiring.before, rewiring.after})
    if (edge && !can_rewire(*edge, running, wanted)) return Effort::restart;
  plan.connections.push_back(std::move(rewiring));
  return Effort::rewire;
}

void add_other(const Change& change, const Graph& running, const Graph& wanted, GraphPlan& plan) {
  Effort effort = change.part == Change::Part::group ? Effort::none : Effort::restart;
  if (change.part == Change::Part::connection) effort = add_connection(change, running, wanted, plan);
  if (change.part == Change::Part::component) effort = add_or_remove(change, running, wanted, plan);
  for (const FieldChange& field : change.fields)
    plan.lines.push_back({title(change), field, is_planned(field) ? Effort::none : effort});
  if (change.fields.empty()) plan.lines.push_back({title(change), {}, effort});
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

GraphPlan plan_of(const Graph& running, const Graph& wanted,
                  const std::map<std::string, Contract>& contracts) {
  GraphPlan plan;
  for (const Change& change : diff(running, wanted)) {
    const bool is_component = change.part == Change::Part::component && change.kind == Change::Kind::changed;
    if (!is_component) {
      add_other(change, running, wanted, plan);
      continue;
    }
    const auto contract = contracts.find(change.name);
    add_component(change, *wanted.find_component(change.name),
                  contract == contracts.end() ? nullptr : &contract->second, plan);
  }
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
  const auto is_in = [](const Graph& other) {
    return [&other](const ComponentNode& node) { return other.find_component(node.name) != nullptr; };
  };
  std::vector<ComponentNode> added = wanted.components;
  std::erase_if(added, is_in(graph));
  std::erase_if(graph.components, std::not_fn(is_in(wanted)));
  for (ComponentNode& node : graph.components) {
    const ComponentNode& now = *wanted.find_component(node.name);
    node.type = now.type;
    node.params = now.params;
    node.start_after = now.start_after;
  }
  std::ranges::move(added, std::back_inserter(graph.components));
  graph.groups = wanted.groups;
  graph.edges = wanted.edges;
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
