// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/system_names.hpp"

#include <algorithm>

#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/xml/names.hpp"

namespace orca::supervisor {
namespace {

Error unknown(const std::string& kind, const std::string& name, const std::vector<std::string>& names) {
  const auto nearest = xml::nearest_name(name, names);
  return fail(Code::not_found, "there is no " + kind + " " + in_quotes(name) +
                                   (nearest ? xml::did_you_mean(nearest) : "; there are: " + listed(names)));
}

}  // namespace

Result<const graph::ComponentNode*> SystemNames::component(const std::string& name) const {
  if (const graph::ComponentNode* const found = graph_.find_component(name)) return found;
  std::vector<std::string> names;
  for (const graph::ComponentNode& node : graph_.components) names.push_back(node.name);
  return unknown("component", name, names);
}

Result<std::vector<const graph::ComponentNode*>> SystemNames::component_or_group(
    const std::string& name) const {
  if (const graph::ComponentNode* const found = graph_.find_component(name)) return std::vector{found};
  const graph::GroupNode* const group = graph_.find_group(name);
  if (group == nullptr) {
    std::vector<std::string> names;
    for (const graph::ComponentNode& node : graph_.components) names.push_back(node.name);
    for (const graph::GroupNode& node : graph_.groups) names.push_back(node.name);
    return unknown("component or group", name, names);
  }
  std::vector<const graph::ComponentNode*> members;
  for (const std::string& component : graph::start_order(graph_))
    if (std::ranges::find(group->components, component) != group->components.end())
      members.push_back(graph_.find_component(component));
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
  if (const graph::ComponentNode* const node = graph_.find_component(name)) return &member_of(*node);
  for (const graph::ComponentNode& node : graph_.components) names.push_back(node.name);
  return unknown("component or process", name, names);
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
