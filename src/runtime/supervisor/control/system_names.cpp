// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/system_names.hpp"

#include <algorithm>
#include <map>

#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/xml/names.hpp"

namespace orca::supervisor {
namespace {

std::vector<std::string> component_names(const graph::Graph& graph) {
  std::vector<std::string> names;
  for (const graph::ComponentNode& node : graph.components) names.push_back(node.name);
  return names;
}

Error unknown(const std::string& kind, const std::string& name, const std::vector<std::string>& names) {
  const auto nearest = xml::nearest_name(name, names);
  return fail(Code::not_found, "there is no " + kind + " " + in_quotes(name) +
                                   (nearest ? xml::did_you_mean(nearest) : "; there are: " + listed(names)));
}

}  // namespace

Result<const graph::ComponentNode*> SystemNames::component(const std::string& name) const {
  if (const graph::ComponentNode* const found = here_.find_component(name)) return found;
  if (const graph::ComponentNode* const found = whole_.find_component(name))
    return elsewhere("component " + name, found->process);
  const graph::HardwareNode* const hardware = whole_.find_hardware(name);
  if (hardware != nullptr && here_.find_hardware(name) == nullptr)
    return elsewhere("hardware " + name, hardware->process);
  return unknown("component", name, component_names(whole_));
}

Result<std::vector<const graph::ComponentNode*>> SystemNames::component_or_group(
    const std::string& name) const {
  if (whole_.find_component(name) != nullptr) {
    const Result<const graph::ComponentNode*> found = component(name);
    if (!found) return found.error();
    return std::vector{*found};
  }
  const graph::GroupNode* const group = whole_.find_group(name);
  if (group == nullptr) {
    std::vector<std::string> names = component_names(whole_);
    for (const graph::GroupNode& node : whole_.groups) names.push_back(node.name);
    return unknown("component or group", name, names);
  }
  std::vector<const graph::ComponentNode*> members;
  for (const std::string& component : graph::start_order(here_))
    if (std::ranges::find(group->components, component) != group->components.end())
      members.push_back(here_.find_component(component));
  if (members.size() < group->components.size()) return spread(*group);
  return members;
}

Result<const graph::ListedPort*> SystemNames::port(const std::string& path) const {
  std::vector<std::string> of_all;
  std::vector<std::string> of_component;
  const std::string owner = path.substr(0, path.rfind('.'));
  for (const graph::ListedPort& port : ports_) {
    if (port.ref.text() == path) return &port;
    of_all.push_back(port.ref.text());
    if (port.ref.component == owner) of_component.push_back(port.ref.text());
  }
  return unknown("port", path, of_component.empty() ? of_all : of_component);
}

Result<Member*> SystemNames::process(const std::string& name) const {
  std::vector<std::string> names;
  for (Member* const member : members_) {
    if (member->name() == name) return member;
    names.push_back(member->name());
  }
  if (const graph::ComponentNode* const node = here_.find_component(name)) return &member_of(*node);
  if (const graph::ComponentNode* const node = whole_.find_component(name))
    return elsewhere("component " + name, node->process);
  for (const graph::ProcessNode& node : graph::processes_of(whole_)) {
    if (node.name == name) return elsewhere("process " + name, name);
    if (std::ranges::find(names, node.name) == names.end()) names.push_back(node.name);
  }
  for (const std::string& component : component_names(whole_)) names.push_back(component);
  return unknown("component or process", name, names);
}

std::string SystemNames::machine_of(const std::string& process) const {
  const auto node = std::ranges::find(whole_.processes, process, &graph::ProcessNode::name);
  return node == whole_.processes.end() ? "" : node->machine;
}

// The graph of a system on several machines does not change while it runs, so there `whole` is what runs.
graph::Graph SystemNames::surroundings_of(const std::string& component) const {
  graph::Graph graph = here_;
  if (!graph::has_neighbours(whole_)) return graph;
  for (const graph::Edge& edge : whole_.edges) {
    const bool is_its = edge.from.component == component || edge.to.component == component;
    const std::string& other = edge.from.component == component ? edge.to.component : edge.from.component;
    if (is_its && here_.find_component(other) == nullptr) graph.edges.push_back(edge);
  }
  return graph;
}

std::optional<std::string> SystemNames::other_machines() const {
  std::vector<std::string> others;
  for (const graph::MachineNode& node : whole_.machines)
    if (!graph::processes_on(whole_, node.name).empty()) others.push_back(node.name);
  if (others.size() < 2) return std::nullopt;
  const std::string here = members_.empty() ? "" : machine_of(members_.front()->name());
  std::erase(others, here);
  return "this is what machine " + here + " knows; for the rest ask on " + listed(others);
}

// Returns the refusal to command something that runs on another machine.
Error SystemNames::elsewhere(const std::string& what, const std::string& process) const {
  const std::string name = machine_of(process);
  const auto machine = std::ranges::find(whole_.machines, name, &graph::MachineNode::name);
  const bool has_address = machine != whole_.machines.end() && !machine->address.empty();
  return fail(Code::failed_precondition,
              what + " runs on machine " + name + "; give this command there" +
                  (has_address ? ": ssh " + machine->address + " orcactl ..." : ""));
}

// Returns the refusal to command a group of which this machine has not all components.
Error SystemNames::spread(const graph::GroupNode& group) const {
  std::map<std::string, std::vector<std::string>> by_machine;
  for (const std::string& name : group.components)
    by_machine[machine_of(whole_.find_component(name)->process)].push_back(name);
  if (by_machine.size() == 1)
    return elsewhere("group " + group.name, whole_.find_component(group.components.front())->process);
  std::string places;
  for (const auto& [machine, components] : by_machine)
    places += (places.empty() ? "" : "; ") + listed(components) + " on machine " + machine;
  return fail(Code::failed_precondition,
              "group " + group.name + " runs on several machines, so it cannot obey as one: " + places +
                  ". Command its components one by one, each on its machine");
}

Member& SystemNames::member(const std::string& process) const {
  return **std::ranges::find(members_, process, [](const Member* member) { return member->name(); });
}

Member& SystemNames::member_of(const graph::ComponentNode& component) const {
  return member(component.process);
}

Result<Member*> SystemNames::ready_member_of(const graph::ComponentNode& component) const {
  return ready(member_of(component));
}

Result<Member*> SystemNames::built_member_of(const graph::ComponentNode& component) const {
  Member& member = member_of(component);
  return member.phase() == Member::Phase::coming_up && member.is_built() ? &member : ready(member);
}

Result<Member*> SystemNames::ready_member(const std::string& process) const { return ready(member(process)); }

Result<Member*> SystemNames::ready_member_of(const graph::HardwareNode& hardware) const {
  return ready(member(hardware.process));
}

Result<Member*> SystemNames::ready(Member& member) {
  if (member.phase() == Member::Phase::up) return &member;
  if (member.phase() == Member::Phase::asleep)
    return fail(Code::unavailable, "process " + member.name() +
                                       " does not run, because nobody needs it; orcactl restart " +
                                       member.name() + " starts it");
  return fail(Code::unavailable, "process " + member.name() + " does not work at present; try again later");
}

}  // namespace orca::supervisor
