// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/diff.hpp"

#include <algorithm>
#include <map>

#include "attributes.hpp"
#include "orca/base/json.hpp"
#include "reading/trading/properties.hpp"

namespace orca::graph {
namespace {

using Fields = std::map<std::string, std::string>;
using Parts = std::map<std::string, Fields>;  // by name

Fields fields_of(const Attributes& attributes) { return {attributes.begin(), attributes.end()}; }

void add_params(const Params& params, Fields& fields) {
  for (const auto& [name, value] : params) fields["param " + name] = value_text(value);
}

std::string port_text(const PortSetting& setting) {
  std::string text;
  for (const auto& [name, value] : attributes_of(setting))
    text += (text.empty() ? "" : " ") + name + "=\"" + value + "\"";
  return text;
}

Fields fields_of(const HardwareNode& node) {
  Fields fields = fields_of(attributes_of(node));
  add_params(node.params, fields);
  return fields;
}

Fields fields_of(const ComponentNode& node) {
  ComponentNode sorted = node;
  std::ranges::sort(sorted.start_after);
  std::ranges::sort(sorted.may_set);
  std::ranges::sort(sorted.may_suspend);
  Fields fields = fields_of(attributes_of(sorted));
  add_params(node.params, fields);
  for (const auto& [name, value] : node.properties) fields["property " + name] = property_text(value);
  for (auto [name, setting] : node.ports) {
    std::ranges::sort(setting.candidates);
    fields["port " + name] = port_text(setting);
  }
  return fields;
}

// Returns what the graph says of the whole system.
Fields fields_of(const Graph& graph) {
  Graph sorted = graph;
  sorted.default_profile.clear();
  std::ranges::sort(sorted.ends);
  Fields fields = fields_of(attributes_of(sorted));
  fields["name"] = graph.name;
  for (const PlannedChange& change : graph.changes)
    fields[kChangeField + attributes_of(change).front().second] = change.file;
  return fields;
}

Parts parts_of(const Graph& graph, Change::Part part) {
  Parts parts;
  if (part == Change::Part::graph) {
    parts["graph"] = fields_of(graph);
  } else if (part == Change::Part::machine) {
    for (const MachineNode& node : graph.machines) parts[node.name] = fields_of(attributes_of(node));
  } else if (part == Change::Part::process) {
    // Without a declaration, "main" is as with one that says nothing.
    for (const ProcessNode& node : graph.processes)
      if (node != ProcessNode{.name = kMainProcess}) parts[node.name] = fields_of(attributes_of(node));
  } else if (part == Change::Part::hardware) {
    for (const HardwareNode& node : graph.hardware) parts[node.name] = fields_of(node);
  } else if (part == Change::Part::component) {
    for (const ComponentNode& node : graph.components) parts[node.name] = fields_of(node);
  } else if (part == Change::Part::group) {
    for (GroupNode node : graph.groups) {
      std::ranges::sort(node.components);
      parts[node.name] = fields_of(attributes_of(node));
    }
  } else {
    // A late-bound edge belongs to the candidates of its port.
    for (const Edge& edge : graph.edges)
      if (!edge.late_bound)
        parts[edge.from.text() + " to " + edge.to.text()] = fields_of(attributes_of(edge));
  }
  return parts;
}

std::vector<FieldChange> field_changes(const Fields& before, const Fields& after) {
  std::map<std::string, FieldChange> changes;
  for (const auto& [field, value] : before) changes[field] = {field, value, ""};
  for (const auto& [field, value] : after) {
    changes[field].field = field;
    changes[field].after = value;
  }
  std::vector<FieldChange> result;
  for (const auto& [field, change] : changes)
    if (before.contains(field) != after.contains(field) || change.before != change.after)
      result.push_back(change);
  return result;
}

void compare(Change::Part part, const Parts& before, const Parts& after, std::vector<Change>& changes) {
  std::map<std::string, Change> sorted;
  for (const auto& [name, fields] : before)
    if (!after.contains(name)) sorted[name] = {Change::Kind::removed, part, name, {}};
  for (const auto& [name, fields] : after) {
    const auto old = before.find(name);
    if (old == before.end()) {
      sorted[name] = {Change::Kind::added, part, name, {}};
    } else if (auto changed = field_changes(old->second, fields); !changed.empty()) {
      sorted[name] = {Change::Kind::changed, part, name, std::move(changed)};
    }
  }
  for (auto& [name, change] : sorted) changes.push_back(std::move(change));
}

const char* to_string(Change::Kind kind) {
  return kind == Change::Kind::added ? "added" : kind == Change::Kind::removed ? "removed" : "changed";
}

const char* to_string(Change::Part part) {
  switch (part) {
    case Change::Part::graph: return "graph";
    case Change::Part::machine: return "machine";
    case Change::Part::process: return "process";
    case Change::Part::hardware: return "hardware";
    case Change::Part::component: return "component";
    case Change::Part::group: return "group";
    case Change::Part::connection: return "connection";
  }
  return "?";
}

std::string shown(const std::string& value) { return value.empty() ? "nothing" : value; }

}  // namespace

std::vector<Change> diff(const Graph& before, const Graph& after) {
  std::vector<Change> changes;
  for (const auto part :
       {Change::Part::graph, Change::Part::machine, Change::Part::process, Change::Part::hardware,
        Change::Part::component, Change::Part::group, Change::Part::connection})
    compare(part, parts_of(before, part), parts_of(after, part), changes);
  return changes;
}

std::string title(const Change& change) {
  const char* sign = change.kind == Change::Kind::added     ? "+ "
                     : change.kind == Change::Kind::removed ? "- "
                                                            : "~ ";
  return sign + std::string(to_string(change.part)) +
         (change.part == Change::Part::graph ? "" : " " + change.name);
}

std::string diff_text(const std::vector<Change>& changes) {
  std::string text;
  for (const Change& change : changes) {
    text += title(change) + "\n";
    for (const FieldChange& field : change.fields)
      text += "    " + field.field + ": " + shown(field.before) + " -> " + shown(field.after) + "\n";
  }
  return text;
}

std::string diff_json(const std::vector<Change>& changes) {
  JsonWriter json;
  json.begin_array();
  for (const Change& change : changes) {
    json.begin_object();
    json.member("kind", to_string(change.kind));
    json.member("part", to_string(change.part));
    json.member("name", change.name);
    json.key("fields").begin_array();
    for (const FieldChange& field : change.fields) {
      json.begin_object();
      json.member("field", field.field);
      json.member("before", field.before);
      json.member("after", field.after);
      json.end();
    }
    json.end();
    json.end();
  }
  json.end();
  return json.text();
}

}  // namespace orca::graph
