// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/showing.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "orca/base/text.hpp"
#include "orca/graph/json.hpp"
#include "orca/graph/print.hpp"
#include "orca/host/component_state.hpp"

namespace orca::supervisor {
namespace {

std::string text_of(const std::set<std::string>& names) {
  return joined(std::vector<std::string>(names.begin(), names.end()), " ");
}

// Returns the state of a component; "on demand" if its process is asleep.
std::string state_of(const Member& member, host::ComponentState state) {
  return member.phase() == Member::Phase::asleep ? "on demand" : host::to_string(state);
}

Cell pid_of(const Member& member) {
  if (member.process() != nullptr) return {"pid", member.process()->pid()};
  Cell none{"pid", ""};
  none.kind = Cell::Kind::number;
  return none;
}

}  // namespace

const PluginFacts& Showing::plugin_of(const std::string& type) const {
  static const PluginFacts unknown;
  const auto found = facts_.plugins.find(type);
  return found == facts_.plugins.end() ? unknown : found->second;
}

void Showing::components(Reply& reply) const {
  const host::Reports reports = ledger_.reports();
  for (const graph::ComponentNode& node : graph_.components) {
    const auto member = std::ranges::find(members_, node.process, [](const Member* m) { return m->name(); });
    if (member == members_.end()) continue;
    const PluginFacts& plugin = plugin_of(node.type);
    reply.add(Record{{"name", node.name},
                     {"type", node.type},
                     {"process", node.process},
                     pid_of(**member),
                     {"state", state_of(**member, reports(node.name).state)},
                     {"plugin", plugin.file},
                     {"build_id", plugin.build_id},
                     {"restarts", (*member)->restarts()}});
  }
}

void Showing::graph(Reply& reply) const {
  reply.add(reply.as_json() ? graph::graph_json(graph_) : graph::print(graph_));
}

void Showing::ports(Reply& reply) const {
  std::vector<graph::ListedPort> ports = facts_.ports;
  graph::mark_in_use(ports, edges_in_use_());
  reply.add(reply.as_json() ? graph::ports_json(ports) : graph::ports_text(ports));
}

void Showing::plugins(Reply& reply) const {
  struct Use {
    std::string build_id;
    std::set<std::string> types;
    std::set<std::string> users;
  };
  std::map<std::string, Use> uses;
  const auto add = [&](const std::string& type, const std::string& user) {
    const PluginFacts& plugin = plugin_of(type);
    Use& use = uses[plugin.file];
    use.build_id = plugin.build_id;
    use.types.insert(type);
    use.users.insert(user);
  };
  for (const graph::ComponentNode& node : graph_.components) add(node.type, node.name);
  for (const graph::HardwareNode& node : graph_.hardware) add(node.type, node.name);
  for (const auto& [file, use] : uses)
    reply.add(Record{{"plugin", file},
                     {"build_id", use.build_id},
                     {"types", text_of(use.types)},
                     {"used_by", text_of(use.users)}});
}

void Showing::names(Reply& reply) const {
  for (const graph::ListedPort& port : facts_.ports) reply.add(Record{{"port", port.ref.text()}});
  for (const graph::ComponentNode& node : graph_.components)
    for (const auto& [name, value] : node.params) reply.add(Record{{"param", node.name + "." + name}});
}

void Showing::counters(const ReplyPtr& reply) const {
  for (Member* const member : members_) {
    if (!member->is_built()) continue;
    member->ask_for(Count{}, [reply](const Answer& answer) {
      for (const Record& record : answer.records) reply->add(record);
      if (!answer.outcome.ok()) reply->refuse(answer.outcome.error());
    });
  }
}

}  // namespace orca::supervisor
