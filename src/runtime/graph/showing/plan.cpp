// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/plan.hpp"

#include <algorithm>

#include "orca/base/text.hpp"

namespace orca::graph {
namespace {

constexpr std::string_view kParam = "param ";

bool is_param(const FieldChange& change) { return change.field.starts_with(kParam); }

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
    plan.lines.push_back({title(change), field, is_known ? effort : Effort::restart});
    if (is_param(field) && effort == Effort::set)
      settings[param_of(field)] = wanted.params.at(param_of(field));
    changes_code = changes_code || (is_known && effort == Effort::exchange);
  }
  if (!settings.empty()) plan.settings[wanted.name] = std::move(settings);
  if (changes_code) plan.exchanges.push_back({wanted.name, wanted.type, wanted.params});
}

void add_other(const Change& change, GraphPlan& plan) {
  const Effort effort = change.part == Change::Part::group ? Effort::none : Effort::restart;
  for (const FieldChange& field : change.fields) plan.lines.push_back({title(change), field, effort});
  if (change.fields.empty()) plan.lines.push_back({title(change), {}, effort});
}

}  // namespace

const char* to_string(Effort effort) {
  switch (effort) {
    case Effort::none: return "at once; nothing runs otherwise";
    case Effort::set: return "between two laps; nothing stops";
    case Effort::exchange: return "tried for 1 s, then exchanged between two laps; nothing stops";
    case Effort::restart: return "only when the system is started again";
  }
  return "?";
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
      add_other(change, plan);
      continue;
    }
    const auto contract = contracts.find(change.name);
    add_component(change, *wanted.find_component(change.name),
                  contract == contracts.end() ? nullptr : &contract->second, plan);
  }
  return plan;
}

void go_over(Graph& graph, const Graph& wanted) {
  for (ComponentNode& node : graph.components) {
    const ComponentNode& now = *wanted.find_component(node.name);
    node.type = now.type;
    node.params = now.params;
  }
  graph.groups = wanted.groups;
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
