// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/print.hpp"
#include "attributes.hpp"
#include "orca/xml/document.hpp"
#include "reading/trading/properties.hpp"

namespace orca::graph {
namespace {

// Writes an attribute. A dollar in its value is doubled, because a single one starts an argument.
std::string attribute(const std::string& name, const std::string& value) {
  std::string doubled;
  for (const char c : value) doubled += c == '$' ? "$$" : std::string(1, c);
  return " " + name + "=\"" + xml::escaped(doubled) + "\"";
}

std::string text_of(const Attributes& attributes) {
  std::string result;
  for (const auto& [name, value] : attributes) result += attribute(name, value);
  return result;
}

std::string named_value(const char* element, const std::string& name, const std::string& value) {
  return std::string("    <") + element + attribute("name", name) + attribute("value", value) + "/>\n";
}

std::string params_text(const Params& params, const Params& here) {
  std::string result;
  for (const auto& [name, value] : params) {
    const auto unwritten = here.find(name);
    if (unwritten == here.end() || unwritten->second != value)
      result += named_value("param", name, value_text(value));
  }
  return result;
}

std::string element(const std::string& name, const std::string& attributes, const std::string& content) {
  const std::string start = "  <" + name + attributes;
  return content.empty() ? start + "/>\n" : start + ">\n" + content + "  </" + name + ">\n";
}

// Returns the text of a machine, process or group.
template <class Node>
std::string plain_text(const char* name, const Node& node) {
  return element(name, attribute("name", node.name) + text_of(attributes_of(node)), "");
}

std::string component_text(const ComponentNode& node) {
  std::string content = params_text(node.params, node.here);
  for (const auto& [name, value] : node.properties)
    content += named_value("property", name, property_text(value));
  for (const auto& [name, setting] : node.ports)
    content += "    <port" + attribute("name", name) + text_of(attributes_of(setting)) + "/>\n";
  return element("component", attribute("name", node.name) + text_of(attributes_of(node)), content);
}

std::string edge_text(const Edge& edge) {
  const std::string ends = attribute("from", edge.from.text()) + attribute("to", edge.to.text());
  return element("connect", ends + text_of(attributes_of(edge)), "");
}

}  // namespace

std::string print(const Graph& graph) {
  const std::string attributes = attribute("name", graph.name) + attribute("version", "1") +
                                 attribute("expanded", "true") + text_of(attributes_of(graph));
  std::string result = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graph" + attributes + ">\n";
  // The profile's content is merged into the graph. Its name stays, so that reading the file back
  // gives the same value.
  if (!graph.default_profile.empty())
    result += element("profile", attribute("name", graph.default_profile), "");
  for (const MachineNode& node : graph.machines) result += plain_text("machine", node);
  for (const ProcessNode& node : graph.processes) result += plain_text("process", node);
  for (const HardwareNode& node : graph.hardware) {
    result += element("hardware", attribute("name", node.name) + text_of(attributes_of(node)),
                      params_text(node.params, node.here));
  }
  for (const ComponentNode& node : graph.components) result += component_text(node);
  for (const GroupNode& node : graph.groups) result += plain_text("group", node);
  for (const Edge& edge : graph.edges)
    if (!edge.late_bound) result += edge_text(edge);
  for (const PlannedChange& change : graph.changes)
    result += element("change", text_of(attributes_of(change)), "");
  return result + "</graph>\n";
}

std::string print_value(const ParamValue& value) { return value_text(value); }

std::map<std::string, std::string> print_values(const Params& params) {
  std::map<std::string, std::string> texts;
  for (const auto& [name, value] : params) texts[name] = print_value(value);
  return texts;
}

}  // namespace orca::graph
