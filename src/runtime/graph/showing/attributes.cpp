// SPDX-License-Identifier: LGPL-3.0-or-later
#include "attributes.hpp"

#include <variant>

#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"

namespace orca::graph {
namespace {

struct ValueText {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return xml::number_text(value); }
  std::string operator()(const std::string& value) const { return value; }
  std::string operator()(const std::vector<std::string>& value) const { return joined(value, ";"); }
};

std::string seconds_text(Duration duration) { return xml::number_text(to_seconds(duration)) + " s"; }

void add(Attributes& attributes, const char* name, const std::string& value) {
  if (!value.empty()) attributes.emplace_back(name, value);
}

void add_trigger(Attributes& attributes, const Trigger& trigger) {
  if (!trigger.waits_for_ports()) return add(attributes, "period", seconds_text(trigger.period));
  add(attributes, "on", joined(trigger.ports, " "));
  if (trigger.kind == Trigger::Kind::on_all) add(attributes, "fuse", "all");
  if (trigger.kind == Trigger::Kind::on_stamps) add(attributes, "fuse", "stamps");
  if (trigger.within > Duration{0}) add(attributes, "within", seconds_text(trigger.within));
  if (trigger.period > Duration{0}) add(attributes, "at_least_every", seconds_text(trigger.period));
}

void add(Attributes& attributes, const Supervision& supervision) {
  const Supervision standard;
  if (supervision.strategy != standard.strategy) add(attributes, "strategy", to_string(supervision.strategy));
  if (supervision.restarts != standard.restarts)
    add(attributes, "restarts", std::to_string(supervision.restarts));
  if (supervision.within != standard.within) add(attributes, "within", seconds_text(supervision.within));
  if (supervision.on_supervisor_loss == OnLoss::go_on) add(attributes, "on_supervisor_loss", "continue");
  if (supervision.adoption_wait != standard.adoption_wait)
    add(attributes, "adoption_wait", seconds_text(supervision.adoption_wait));
  if (supervision.machine_wait != standard.machine_wait)
    add(attributes, "machine_wait", seconds_text(supervision.machine_wait));
}

std::string processors_text(const std::vector<int>& processors) {
  std::string text;
  for (const int processor : processors) text += (text.empty() ? "" : " ") + std::to_string(processor);
  return text;
}

}  // namespace

std::string value_text(const ParamValue& value) { return std::visit(ValueText{}, value); }

Attributes attributes_of(const Graph& graph) {
  Attributes result;
  add(result, "ends", joined(graph.ends, " "));
  add(result, "default_profile", graph.default_profile);
  add(result, "plugins", joined(graph.plugin_dirs, ";"));
  if (graph.domain != 0) add(result, "domain", std::to_string(graph.domain));
  add(result, "join", graph.team.name);
  if (graph.team.domain != 0) add(result, "team_domain", std::to_string(graph.team.domain));
  add(result, "team_interface", graph.team.interface);
  add(result, graph.supervision);
  if (graph.records_always) add(result, "record", "always");
  if (graph.record_space != Graph{}.record_space)
    add(result, "record_space", std::to_string(graph.record_space) + " B");
  if (graph.secured) add(result, "security", "on");
  return result;
}

Attributes attributes_of(const MachineNode& node) {
  Attributes result;
  add(result, "address", node.address);
  add(result, "interface", node.interface);
  if (node.on_loss == OnLoss::go_on) add(result, "on_loss", "go_on");
  if (node.loss_limit != MachineNode{}.loss_limit) add(result, "loss_limit", seconds_text(node.loss_limit));
  if (node.delay > Duration{0}) add(result, "delay", seconds_text(node.delay));
  return result;
}

Attributes attributes_of(const ProcessNode& node) {
  const ProcessNode standard;
  Attributes result;
  add(result, "machine", node.machine);
  if (node.executor == Backend::fiber) add(result, "executor", "fiber");
  if (node.spin != standard.spin) add(result, "spin", seconds_text(node.spin));
  add(result, "processors", processors_text(node.processors));
  if (node.cores > 0) add(result, "cores", std::to_string(node.cores));
  if (node.delay > Duration{0}) add(result, "delay", seconds_text(node.delay));
  if (node.priority) add(result, "priority", std::to_string(*node.priority));
  if (node.lock_memory) add(result, "lock_memory", "true");
  if (node.memory) add(result, "memory", std::to_string(*node.memory) + " B");
  if (node.restart != standard.restart) add(result, "restart", to_string(node.restart));
  add(result, "start", node.on_demand ? "on_demand" : "");
  if (node.on_demand && node.idle_time == Duration{0}) add(result, "stay", "warm");
  if (node.idle_time > Duration{0}) add(result, "idle_time", seconds_text(node.idle_time));
  if (node.hang_limit != standard.hang_limit) add(result, "hang_limit", seconds_text(node.hang_limit));
  return result;
}

Attributes attributes_of(const HardwareNode& node) { return {{"type", node.type}}; }

Attributes attributes_of(const ComponentNode& node) {
  Attributes result{{"type", node.type}};
  add(result, "hardware", node.hardware);
  if (node.process != kMainProcess) add(result, "process", node.process);
  if (node.priority != 0) add(result, "priority", std::to_string(node.priority));
  if (node.autonomous) add(result, "autonomous", value_text(*node.autonomous));
  if (node.watchable) add(result, "watchable", "true");
  if (node.trigger) add_trigger(result, *node.trigger);
  if (!node.takes.file.empty()) {
    add(result, "takes", node.takes.file);
  } else if (!node.takes.quantiles.empty()) {
    add(result, "takes", xml::number_text(node.takes.quantiles.front()) + " s");
  }
  add(result, "start", node.on_demand ? "on_demand" : "");
  add(result, "stay", node.stay_warm ? "warm" : "");
  if (node.on_demand && !node.stay_warm) add(result, "idle_time", seconds_text(node.idle_time));
  add(result, "start_after", joined(node.start_after, " "));
  add(result, "may_set", joined(node.may_set, " "));
  add(result, "may_suspend", joined(node.may_suspend, " "));
  if (node.restore_last) add(result, "restore", "last");
  if (node.may_fail) add(result, "may_fail", "true");
  return result;
}

Attributes attributes_of(const PortSetting& setting) {
  Attributes result;
  add(result, "as", setting.alias);
  if (setting.disabled) add(result, "disabled", "true");
  std::vector<std::string> candidates;
  for (const PortRef& candidate : setting.candidates) candidates.push_back(candidate.text());
  add(result, "candidates", joined(candidates, " "));
  add(result, "topic", setting.topic);
  add(result, "message", setting.message);
  add(result, "team", setting.team);
  return result;
}

Attributes attributes_of(const GroupNode& node) { return {{"components", joined(node.components, " ")}}; }

Attributes attributes_of(const PlannedChange& change) {
  return {{"at", seconds_text(change.at)}, {"graph", change.file}};
}

Attributes attributes_of(const Edge& edge) {
  Attributes result;
  if (edge.pattern != Pattern::query) {
    add(result, "queue", std::to_string(edge.queue.depth));
    add(result, "overflow", to_string(edge.queue.overflow));
    if (edge.queue.overflow == QueuePolicy::Overflow::block)
      add(result, "block_limit", seconds_text(edge.queue.block_limit));
  }
  if (edge.pattern == Pattern::push) {
    add(result, "interval", seconds_text(edge.interval));
    add(result, "deadline", seconds_text(edge.queue.deadline));
    if (const auto limit = edge.queue.drop_limit)
      add(result, "drop_limit", limit == QueuePolicy::kAnyDrops ? "any" : std::to_string(*limit));
  }
  if (edge.queue.confirm == QueuePolicy::Confirm::handled)
    add(result, "confirm", to_string(edge.queue.confirm));
  if (edge.link != Link::local) add(result, "link", to_string(edge.link));
  if (edge.choice > 0) add(result, "choice", std::to_string(edge.choice));
  return result;
}

}  // namespace orca::graph
