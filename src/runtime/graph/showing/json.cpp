// SPDX-License-Identifier: LGPL-3.0-or-later
#include <variant>

#include "attributes.hpp"
#include "orca/base/json.hpp"
#include "orca/graph/print.hpp"

namespace orca::graph {
namespace {

void write(const Attributes& attributes, JsonWriter& json) {
  for (const auto& [name, value] : attributes) json.member(name, value);
}

// Writes parameters in SI. Numbers and flags keep their type.
void write(const Params& params, JsonWriter& json) {
  json.key("params").begin_object();
  for (const auto& [name, value] : params)
    std::visit([&, &key = name](const auto& content) { json.member(key, content); }, value);
  json.end();
}

// Writes properties in SI. Numbers and flags keep their type.
void write(const Properties& properties, JsonWriter& json) {
  json.key("properties").begin_object();
  for (const auto& [name, value] : properties) {
    if (const auto* number = std::get_if<Quantity>(&value))
      json.member(name, number->value);
    else if (const auto* flag = std::get_if<bool>(&value))
      json.member(name, *flag);
    else
      json.member(name, std::get<std::string>(value));
  }
  json.end();
}

// Writes machines, processes or groups.
template <class Node>
void write(const char* key, const std::vector<Node>& nodes, JsonWriter& json) {
  json.key(key).begin_array();
  for (const Node& node : nodes) {
    json.begin_object();
    json.member("name", node.name);
    write(attributes_of(node), json);
    json.end();
  }
  json.end();
}

void write(const ComponentNode& node, JsonWriter& json) {
  json.begin_object();
  json.member("name", node.name);
  write(attributes_of(node), json);
  write(node.params, json);
  write(node.properties, json);
  json.key("ports").begin_object();
  for (const auto& [name, setting] : node.ports) {
    json.key(name).begin_object();
    write(attributes_of(setting), json);
    json.end();
  }
  json.end();
  json.end();
}

void write(const Edge& edge, JsonWriter& json) {
  json.begin_object();
  json.member("from", edge.from.text());
  json.member("to", edge.to.text());
  json.member("pattern", to_string(edge.pattern));
  json.member("late_bound", edge.late_bound);
  write(attributes_of(edge), json);
  json.end();
}

}  // namespace

std::string graph_json(const Graph& graph) {
  JsonWriter json;
  json.begin_object();
  json.member("name", graph.name);
  write(attributes_of(graph), json);
  write("machines", graph.machines, json);
  write("processes", graph.processes, json);
  json.key("hardware").begin_array();
  for (const HardwareNode& node : graph.hardware) {
    json.begin_object();
    json.member("name", node.name);
    write(attributes_of(node), json);
    write(node.params, json);
    json.end();
  }
  json.end();
  json.key("components").begin_array();
  for (const ComponentNode& node : graph.components) write(node, json);
  json.end();
  write("groups", graph.groups, json);
  json.key("connections").begin_array();
  for (const Edge& edge : graph.edges) write(edge, json);
  json.end();
  json.key("changes").begin_array();
  for (const PlannedChange& change : graph.changes) {
    json.begin_object();
    write(attributes_of(change), json);
    json.end();
  }
  json.end();
  json.end();
  return json.text();
}

}  // namespace orca::graph
