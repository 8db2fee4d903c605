// SPDX-License-Identifier: LGPL-3.0-or-later
#include "renewal.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>

#include "orca/graph/placement.hpp"

namespace orca::graph {
namespace {

constexpr std::string_view kParam = "param ";

const Contract* contract_of(const Way& way, const std::string& component) {
  const auto found = way.contracts.find(component);
  return found == way.contracts.end() ? nullptr : &found->second;
}

bool can_change(const FieldChange& change, const Contract* contract) {
  const ParamContract* const param = contract == nullptr ? nullptr : contract->param(param_of(change));
  return param != nullptr && !param->fixed;
}

std::set<std::string> names_of_processes(const Graph& graph) {
  std::set<std::string> names;
  for (const ProcessNode& node : processes_of(graph)) names.insert(node.name);
  return names;
}

// A search for the processes that cannot stay.
class Search {
 public:
  explicit Search(const Way& way) : way_(way) {}

  std::set<std::string> run(const std::vector<Change>& changes) {
    compare_processes();
    for (const Change& change : changes) look_at(change);
    for (const Graph* const graph : {&way_.running, &way_.wanted})
      for (const Edge& edge : graph->edges) look_at(edge);
    return std::move(found_);
  }

 private:
  // A process that was alone has no memory in common with others.
  void compare_processes() {
    const std::set<std::string> before = names_of_processes(way_.running);
    const std::set<std::string> after = names_of_processes(way_.wanted);
    std::ranges::set_symmetric_difference(before, after, std::inserter(found_, found_.end()));
    if (before.size() == 1 && after.size() > 1) found_.insert(*before.begin());
  }

  void look_at(const Change& change) {
    if (change.part == Change::Part::process && is_used(change.name)) found_.insert(change.name);
    if (change.part == Change::Part::hardware)
      for (const Graph* const graph : {&way_.running, &way_.wanted})
        if (const HardwareNode* const node = graph->find_hardware(change.name)) found_.insert(node->process);
    if (change.part == Change::Part::component) look_at_component(change);
    if (change.part == Change::Part::connection) changed_.insert(change.name);
  }

  [[nodiscard]] bool is_used(const std::string& process) const {
    return names_of_processes(way_.running).contains(process) ||
           names_of_processes(way_.wanted).contains(process);
  }

  void look_at_component(const Change& change) {
    const ComponentNode* const before = way_.running.find_component(change.name);
    const ComponentNode* const after = way_.wanted.find_component(change.name);
    const bool stays = before != nullptr && after != nullptr && before->process == after->process;
    if (stays ? can_change_there(change, *after) : can_come_or_go(before, after)) return;
    for (const ComponentNode* const node : {before, after})
      if (node != nullptr) found_.insert(node->process);
  }

  [[nodiscard]] bool can_change_there(const Change& change, const ComponentNode& wanted) const {
    const bool is_code = std::ranges::all_of(change.fields, [](const FieldChange& field) {
      return concerns_code(field) || field.field == "start_after";
    });
    return is_code && (wanted.hardware.empty() || only_sets(change, contract_of(way_, change.name)));
  }

  // One that is in another process than before does not come or go.
  [[nodiscard]] bool can_come_or_go(const ComponentNode* before, const ComponentNode* after) const {
    if (before != nullptr && after != nullptr) return false;
    const ComponentNode& node = before != nullptr ? *before : *after;
    return !node.on_demand && !starts_on_demand(way_.running, node.process);
  }

  // The ends of a connection know where their peer's strand is waked, and over DDS which process it is in.
  void look_at(const Edge& edge) {
    const bool is_new = edge.link == Link::dds && changed_.contains(edge.name());
    if (!is_new && !has_moved(edge.from.component, edge) && !has_moved(edge.to.component, edge)) return;
    for (const Graph* const graph : {&way_.running, &way_.wanted})
      for (const PortRef* const end : {&edge.from, &edge.to})
        if (const ComponentNode* const node = graph->find_component(end->component))
          found_.insert(node->process);
  }

  [[nodiscard]] bool has_moved(const std::string& component, const Edge& edge) const {
    const ComponentNode* const before = way_.running.find_component(component);
    const ComponentNode* const after = way_.wanted.find_component(component);
    if (before == nullptr || after == nullptr) return false;
    if (edge.link == Link::dds && before->process != after->process) return true;
    return word_of(way_.running, *before) != word_of(way_.wanted, *after);
  }

  // Returns what the strand of a component is waked by: the fibers of a process have one word together.
  [[nodiscard]] std::string word_of(const Graph& graph, const ComponentNode& node) const {
    const auto process = std::ranges::find(graph.processes, node.process, &ProcessNode::name);
    const Backend own = process == graph.processes.end() ? ProcessNode{}.executor : process->executor;
    return way_.means.executor.value_or(own) == Backend::fiber ? "process " + node.process : "";
  }

  const Way& way_;
  std::set<std::string> found_;
  std::set<std::string> changed_;  // connections
};

// A connection that a port chooses from, and where its ends are.
using Choice = std::tuple<std::string, Link, std::uint32_t, std::string, std::string>;

std::set<Choice> choices_of(const Graph& graph) {
  std::set<Choice> choices;
  for (const Edge& edge : graph.edges)
    if (!is_plain(edge) || edge.late_bound)
      choices.emplace(edge.name(), edge.link, edge.choice, graph.find_component(edge.from.component)->process,
                      graph.find_component(edge.to.component)->process);
  return choices;
}

}  // namespace

std::string param_of(const FieldChange& change) {
  return change.field.starts_with(kParam) ? change.field.substr(kParam.size()) : "";
}

bool concerns_code(const FieldChange& change) { return change.field == "type" || !param_of(change).empty(); }

bool only_sets(const Change& change, const Contract* contract) {
  return std::ranges::all_of(change.fields, [&](const FieldChange& field) {
    return field.field != "type" && (param_of(field).empty() || can_change(field, contract));
  });
}

bool is_plain(const Edge& edge) { return edge.choice == 0; }

std::set<std::string> processes_to_renew(const Way& way, const std::vector<Change>& changes) {
  return Search(way).run(changes);
}

bool keeps_choices(const Way& way) { return choices_of(way.running) == choices_of(way.wanted); }

}  // namespace orca::graph
