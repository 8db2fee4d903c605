// SPDX-License-Identifier: LGPL-3.0-or-later
#include <variant>

#include "orca/graph/graph.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"

namespace orca::graph {
namespace {

std::string joined(const std::vector<std::string>& parts, const char* separator) {
  std::string result;
  for (const std::string& part : parts) result += (result.empty() ? "" : separator) + part;
  return result;
}

struct ValueText {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return xml::number_text(value); }
  std::string operator()(const std::string& value) const { return value; }
  std::string operator()(const std::vector<std::string>& value) const { return joined(value, ";"); }
};

std::string seconds_text(Duration duration) { return xml::number_text(to_seconds(duration)) + " s"; }

// A value as it stands in the file: a dollar is doubled, because a single one starts an argument.
std::string attribute(const char* name, const std::string& value) {
  std::string doubled;
  for (const char c : value) doubled += c == '$' ? "$$" : std::string(1, c);
  return std::string(" ") + name + "=\"" + xml::escaped(doubled) + "\"";
}

std::string optional_attribute(const char* name, const std::string& value) {
  return value.empty() ? "" : attribute(name, value);
}

std::string named_value(const char* element, const std::string& name, const std::string& value) {
  return std::string("    <") + element + attribute("name", name) + attribute("value", value) + "/>\n";
}

std::string params_text(const Params& params) {
  std::string result;
  for (const auto& [name, value] : params)
    result += named_value("param", name, std::visit(ValueText{}, value));
  return result;
}

std::string element(const std::string& name, const std::string& attributes, const std::string& content) {
  const std::string start = "  <" + name + attributes;
  return content.empty() ? start + "/>\n" : start + ">\n" + content + "  </" + name + ">\n";
}

std::string trigger_text(const std::optional<Trigger>& trigger) {
  if (!trigger) return {};
  if (trigger->kind == Trigger::Kind::on_port) return attribute("on", trigger->port);
  return trigger->kind == Trigger::Kind::period ? attribute("period", seconds_text(trigger->period)) : "";
}

std::string loading_text(const ComponentNode& node) {
  if (!node.on_demand) return {};
  return attribute("start", "on_demand") +
         (node.stay_warm ? attribute("stay", "warm") : attribute("idle_time", seconds_text(node.idle_time)));
}

std::string component_text(const ComponentNode& node) {
  std::string attributes = attribute("name", node.name) + attribute("type", node.type);
  attributes += optional_attribute("hardware", node.hardware) + optional_attribute("process", node.process);
  if (node.priority != 0) attributes += attribute("priority", std::to_string(node.priority));
  if (node.autonomous) attributes += attribute("autonomous", ValueText{}(*node.autonomous));
  attributes += trigger_text(node.trigger) + loading_text(node);
  attributes += optional_attribute("start_after", joined(node.start_after, " "));
  std::string content = params_text(node.params);
  for (const auto& [name, value] : node.properties) content += named_value("property", name, value);
  return element("component", attributes, content);
}

std::string edge_text(const Edge& edge) {
  std::string attributes = attribute("from", edge.from.text()) + attribute("to", edge.to.text());
  if (edge.pattern != Pattern::query) {
    const bool newest = edge.queue.overflow == QueuePolicy::Overflow::drop_newest;
    attributes += attribute("queue", std::to_string(edge.queue.depth));
    attributes += attribute("overflow", newest ? "drop_newest" : "drop_oldest");
  }
  if (edge.pattern == Pattern::push) attributes += attribute("interval", seconds_text(edge.interval));
  return element("connect", attributes, "");
}

}  // namespace

std::string print(const Graph& graph) {
  std::string attributes = attribute("name", graph.name) + attribute("version", "1");
  attributes += optional_attribute("ends", joined(graph.ends, " "));
  attributes += optional_attribute("default_profile", graph.default_profile);
  attributes += optional_attribute("plugins", joined(graph.plugin_dirs, ";"));
  if (graph.seed) attributes += attribute("seed", std::to_string(*graph.seed));
  std::string result = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graph" + attributes + ">\n";
  // Its content is merged into the graph; the name stays, so that the file reads back as the same value.
  if (!graph.default_profile.empty())
    result += element("profile", attribute("name", graph.default_profile), "");
  for (const HardwareNode& node : graph.hardware) {
    result += element("hardware", attribute("name", node.name) + attribute("type", node.type),
                      params_text(node.params));
  }
  for (const ComponentNode& node : graph.components) result += component_text(node);
  for (const Edge& edge : graph.edges) result += edge_text(edge);
  return result + "</graph>\n";
}

}  // namespace orca::graph
