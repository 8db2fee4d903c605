// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/newcomers.hpp"

#include <algorithm>
#include <cstdio>

#include "orca/graph/placement.hpp"

namespace orca::supervisor {
namespace {

std::string seconds_text(Duration time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", to_seconds(time));
  return text;
}

std::string effect_on(const Member* member, bool stays) {
  if (member == nullptr) return "begins";
  if (!stays) return "ends";
  const std::optional<Duration>& time = member->starts().time;
  return "is started again" +
         (time ? ", which took " + seconds_text(*time) + " the last time" : std::string());
}

}  // namespace

std::vector<graph::ComponentNode> newcomers_in(const std::set<std::string>& processes,
                                               const graph::Graph& running, const graph::Graph& wanted) {
  std::vector<graph::ComponentNode> newcomers;
  for (const graph::ComponentNode& node : wanted.components) {
    const graph::ComponentNode* const before = running.find_component(node.name);
    const bool is_known_there = before != nullptr && before->process == node.process;
    if (processes.contains(node.process) && !is_known_there) newcomers.push_back(node);
  }
  return newcomers;
}

Members staying(const Members& all, const std::set<std::string>& renewed) {
  Members members = all;
  std::erase_if(members, [&](const Member* member) { return renewed.contains(member->name()); });
  return members;
}

std::vector<Record> records_of(const std::set<std::string>& renewed, const Members& all,
                               const graph::Graph& wanted) {
  const std::vector<graph::ProcessNode> after = graph::processes_of(wanted);
  std::vector<Record> records;
  for (const std::string& name : renewed) {
    const auto member = std::ranges::find(all, name, &Member::name);
    const bool stays = std::ranges::find(after, name, &graph::ProcessNode::name) != after.end();
    records.push_back({{"part", "= process " + name},
                       {"field", ""},
                       {"before", ""},
                       {"after", ""},
                       {"effect", effect_on(member == all.end() ? nullptr : *member, stays)}});
  }
  return records;
}

}  // namespace orca::supervisor
