// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/showing.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "orca/base/text.hpp"
#include "orca/graph/print.hpp"
#include "orca/host/alarm.hpp"
#include "orca/host/component_state.hpp"
#include "orca/plugin/object_library.hpp"

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

// Returns the names of the plugin files that stay in memory although nothing uses them.
std::set<std::string> pinned_files(const std::vector<host::KeptAlarm>& alarms) {
  std::set<std::string> names;
  for (const host::KeptAlarm& kept : alarms)
    if (kept.alarm.kind() == idl::PLUGIN_PINNED) names.insert(kept.alarm.source());
  return names;
}

// Returns how much memory the process of a component has for itself; all its components share it.
Cell memory_of(const Member& member) {
  constexpr double kMega = 1e6;
  const auto bytes = member.process() != nullptr ? member.process()->memory() : std::nullopt;
  if (bytes) return {"memory_mb", static_cast<double>(*bytes) / kMega, 1};
  Cell none{"memory_mb", ""};
  none.kind = Cell::Kind::number;
  return none;
}

// Returns the kinds of the alarms that are not over and concern a component: itself, its hardware, its process, or, if it
// serves something that may move, all motors.
std::string alarms_of(const graph::ComponentNode& node, const std::vector<host::KeptAlarm>& alarms) {
  std::set<std::string> kinds;
  for (const host::KeptAlarm& kept : alarms) {
    const idl::Alarm& alarm = kept.alarm;
    const bool is_estop = alarm.kind() == idl::ESTOP;
    const bool is_of_all = alarm.source().empty() && kept.process.empty() && is_estop;
    const bool is_of_hardware = !node.hardware.empty() && (is_of_all || alarm.source() == node.hardware ||
                                                           (is_estop && alarm.source() == node.process));
    if (alarm.active() && (alarm.source() == node.name || is_of_hardware)) kinds.insert(kind_text(alarm));
  }
  return text_of(kinds);
}

}  // namespace

void Showing::machines(Reply& reply) const {
  if (machines_) return machines_(reply);
  reply.note("the whole system runs on this machine, with one clock");
}

void Showing::team(Reply& reply) const {
  if (team_) return team_(reply);
  reply.note("the system is in no team, or another machine of it speaks to the team");
}

void Showing::components(Reply& reply, const std::map<std::string, double>& lines_per_s) const {
  const host::Reports reports = ledger_.reports();
  for (const graph::ComponentNode& node : graph_.components) {
    const auto member = std::ranges::find(members_, node.process, [](const Member* m) { return m->name(); });
    if (member == members_.end()) continue;
    const CodeFacts code = exchanging_.code_of(node);
    const auto lines = lines_per_s.find(node.name);
    reply.add(Record{{"name", node.name},
                     {"type", code.type},
                     {"process", node.process},
                     pid_of(**member),
                     {"state", state_of(**member, reports(node.name).state)},
                     {"plugin", code.plugin.file},
                     {"build_id", code.plugin.build_id},
                     {"restarts", (*member)->restarts()},
                     {"alarms", alarms_of(node, ledger_.alarms())},
                     memory_of(**member),
                     {"log_per_s", lines != lines_per_s.end() ? lines->second : 0.0, 1}});
  }
}

void Showing::graph(Reply& reply) const {
  reply.add(reply.as_json() ? graph::graph_json(whole_) : graph::print(whole_));
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
    std::uint64_t swaps = 0;  // that put it in another one's place
  };
  std::map<std::string, Use> uses;
  const auto add = [&](const CodeFacts& code, const std::string& user) {
    Use& use = uses[code.plugin.file];
    use.build_id = code.plugin.build_id;
    use.types.insert(code.type);
    use.users.insert(user);
    use.swaps += code.swaps;
  };
  for (const graph::ComponentNode& node : graph_.components) add(exchanging_.code_of(node), node.name);
  for (const graph::HardwareNode& node : graph_.hardware) add(exchanging_.code_of(node), node.name);
  std::set<std::string> pinned = pinned_files(ledger_.alarms());
  const auto show = [&](const std::string& file, const Use& use, bool is_pinned) {
    reply.add(Record{{"plugin", file},
                     {"build_id", use.build_id},
                     {"types", text_of(use.types)},
                     {"used_by", text_of(use.users)},
                     {"swaps", use.swaps},
                     {"pinned", is_pinned}});
  };
  for (const auto& [file, use] : uses)
    show(file, use, pinned.erase(std::filesystem::path(file).filename().string()) > 0);
  for (const std::string& file : pinned) show(file, {}, true);
}

void Showing::objects(Reply& reply) {
  for (const plugin::ObjectLibrary& library : plugin::object_libraries())
    reply.add(Record{{"library", library.file}, {"types", joined(library.types, ", ")}});
}

void Showing::names(Reply& reply) const {
  for (const graph::ListedPort& port : facts_.ports) reply.add(Record{{"port", port.ref.text()}});
  for (const graph::GroupNode& node : graph_.groups) reply.add(Record{{"group", node.name}});
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
