// SPDX-License-Identifier: LGPL-3.0-or-later
#include "parameter_settings.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"
#include "reading/command_line.hpp"

namespace orca::graph {
namespace {

Node* find(std::vector<Node>& nodes, const std::string& name) {
  const auto is_it = [&](const Node& node) { return !node.duplicate && node.value("name") == name; };
  const auto found = std::ranges::find_if(nodes, is_it);
  return found == nodes.end() ? nullptr : &*found;
}

void set_one(Node& node, const std::string& param, const Text& value) {
  const auto is_it = [&](const Node& child) { return child.is("param") && child.value("name") == param; };
  std::erase_if(node.children, is_it);
  Node set{graph_rules().find("param"), value.position, {}, {}};
  set.attributes.emplace("name", Text{param, value.position, true, ""});
  set.attributes.emplace("value", value);
  node.children.push_back(std::move(set));
}

void report_unknown(const std::string& setting, const std::string& name, const Assembly& assembly,
                    const Parts& parts, Report& report) {
  if (assembly.excused.contains(name)) return;
  std::vector<std::string> names;
  for (const std::vector<Node>* nodes : {&parts.components, &parts.hardware})
    for (const Node& node : *nodes)
      if (!node.duplicate && !node.value("name").empty()) names.push_back(node.value("name"));
  const std::string hint = report.hint_in_contexts(name, names);
  if (hint.empty() && (parts.some_missing || assembly.names_incomplete)) return;
  report.error(codes::kBadSetting, command_line(),
               shown_setting(setting) + ": there is no component or hardware " + in_quotes(name) +
                   (hint.empty() ? "; the graph has: " + listed(names) : hint));
}

}  // namespace

void set_parameters(const Assembly& assembly, Parts& parts, Report& report) {
  for (const auto& [setting, value] : assembly.parameters) {
    const std::size_t dot = setting.rfind('.');
    const std::string name = setting.substr(0, dot);
    Node* const component = find(parts.components, name);
    Node* const hardware = find(parts.hardware, name);
    if (component != nullptr && hardware != nullptr) {
      report.error(codes::kBadSetting, command_line(),
                   shown_setting(setting) + ": " + in_quotes(name) +
                       " is a component and a hardware; give one of them another name");
    } else if (Node* const node = component != nullptr ? component : hardware) {
      set_one(*node, setting.substr(dot + 1), value);
    } else {
      report_unknown(setting, name, assembly, parts, report);
    }
  }
}

}  // namespace orca::graph
