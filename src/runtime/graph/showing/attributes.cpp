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

}  // namespace

std::string value_text(const ParamValue& value) { return std::visit(ValueText{}, value); }

Attributes attributes_of(const Graph& graph) {
  Attributes result;
  add(result, "ends", joined(graph.ends, " "));
  add(result, "default_profile", graph.default_profile);
  add(result, "plugins", joined(graph.plugin_dirs, ";"));
  if (graph.seed) add(result, "seed", std::to_string(*graph.seed));
  return result;
}

Attributes attributes_of(const HardwareNode& node) { return {{"type", node.type}}; }

Attributes attributes_of(const ComponentNode& node) {
  Attributes result{{"type", node.type}};
  add(result, "hardware", node.hardware);
  if (node.priority != 0) add(result, "priority", std::to_string(node.priority));
  if (node.autonomous) add(result, "autonomous", value_text(*node.autonomous));
  if (node.trigger) add_trigger(result, *node.trigger);
  add(result, "start", node.on_demand ? "on_demand" : "");
  add(result, "stay", node.stay_warm ? "warm" : "");
  if (node.on_demand && !node.stay_warm) add(result, "idle_time", seconds_text(node.idle_time));
  add(result, "start_after", joined(node.start_after, " "));
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
  return result;
}

Attributes attributes_of(const Edge& edge) {
  Attributes result;
  if (edge.pattern != Pattern::query) {
    add(result, "queue", std::to_string(edge.queue.depth));
    add(result, "overflow", to_string(edge.queue.overflow));
    if (edge.queue.overflow == QueuePolicy::Overflow::block)
      add(result, "block_limit", seconds_text(edge.queue.block_limit));
  }
  if (edge.pattern != Pattern::push) return result;
  add(result, "interval", seconds_text(edge.interval));
  add(result, "deadline", seconds_text(edge.queue.deadline));
  if (edge.queue.drop_limit) add(result, "drop_limit", std::to_string(*edge.queue.drop_limit));
  return result;
}

}  // namespace orca::graph
