// SPDX-License-Identifier: LGPL-3.0-or-later
#include "profiles.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "codes.hpp"
#include "naming.hpp"
#include "orca/xml/names.hpp"

namespace orca::graph {
namespace {

// What makes two nodes the same one: the name, or both ends of a connection. Nothing if that is not known.
std::optional<std::string> identity(const Node& node) {
  const bool edge = node.is("connect");
  const std::string name = edge ? node.value("from") : node.value("name");
  if (name.empty() || (edge && node.value("to").empty())) return std::nullopt;
  return edge ? name + " to " + node.value("to") : name;
}

void override_child(Node& base, const Node& child) {
  const auto same = [&](const Node& other) {
    return other.rule == child.rule && other.value("name") == child.value("name");
  };
  const auto found = std::ranges::find_if(base.children, same);
  if (found == base.children.end()) {
    base.children.push_back(child);
  } else {
    *found = child;
  }
}

void override_node(Node& base, const Node& over) {
  // Parameters of one type mean nothing to another.
  const bool both_typed = over.known("type") != nullptr && base.known("type") != nullptr;
  if (both_typed && over.value("type") != base.value("type")) {
    std::erase_if(base.children, [](const Node& child) { return child.is("param"); });
  }
  if (over.find("period") != nullptr) base.attributes.erase("on");
  if (over.find("on") != nullptr) base.attributes.erase("period");
  for (const auto& [name, text] : over.attributes) base.attributes.insert_or_assign(name, text);
  for (const Node& child : over.children) override_child(base, child);
}

// One kind of parts while sections are merged into it.
class Merger {
 public:
  Merger(std::vector<Node>& nodes, Report& report) : nodes_(nodes), report_(report) {}

  void start_section() { section_.clear(); }

  void add(const Node& node) {
    const auto key = identity(node);
    if (!key) return nodes_.push_back(node);
    const auto [first, fresh] = section_.try_emplace(*key, node.position);
    if (!fresh) return add_duplicate(node, first->second);
    const auto [index, is_new] = index_.try_emplace(*key, nodes_.size());
    if (is_new) {
      nodes_.push_back(node);
    } else {
      override_node(nodes_[index->second], node);
    }
  }

 private:
  void add_duplicate(const Node& node, const xml::Position& first) {
    if (node.is("connect")) {
      report_.error(codes::kDuplicateEdge, node.position,
                    "the connection from " + in_quotes(node.value("from")) + " to " +
                        in_quotes(node.value("to")) + " exists already at " + first.text());
    } else {
      report_.error(codes::kDuplicateName, node.place("name"),
                    "the name of " + node.title() + " is taken already at " + first.text());
    }
    nodes_.push_back(node);
    nodes_.back().duplicate = true;
  }

  std::vector<Node>& nodes_;
  Report& report_;
  std::map<std::string, xml::Position> section_;  // what the present section has defined
  std::map<std::string, std::size_t> index_;
};

void report_unknown(const std::string& wanted, const xml::Position& position,
                    const std::vector<std::string>& names, Report& report) {
  report.error(codes::kUnknownProfile, position,
               "there is no profile " + in_quotes(wanted) + "; the graph has: " + xml::listed(names) +
                   report.hint(wanted, names));
}

std::map<std::string, const Node*> profiles_of(const Node& graph, Report& report) {
  std::map<std::string, const Node*> profiles;
  for (const Node& child : graph.children) {
    const Text* name = child.is("profile") ? child.known("name") : nullptr;
    if (name == nullptr) continue;
    if (const auto fault = name_fault(name->value)) {
      report.error(codes::kBadName, name->position, child.title() + ": " + *fault);
    }
    const auto [first, fresh] = profiles.try_emplace(name->value, &child);
    if (fresh) continue;
    report.error(codes::kDuplicateName, name->position,
                 "the name of " + child.title() + " is taken already at " + first->second->position.text());
  }
  return profiles;
}

// What is asked for, and where.
std::vector<std::pair<std::string, xml::Position>> wanted_profiles(const Node& graph,
                                                                   const std::vector<std::string>& chosen) {
  std::vector<std::pair<std::string, xml::Position>> wanted;
  for (const std::string& name : chosen) wanted.push_back({name, {"command line", 0, 0}});
  const Text* default_profile = graph.known("default_profile");
  if (chosen.empty() && default_profile != nullptr) {
    wanted.emplace_back(default_profile->value, default_profile->position);
  }
  return wanted;
}

std::vector<const Node*> chosen_profiles(const Node& graph, const std::vector<std::string>& chosen,
                                         Report& report) {
  const auto profiles = profiles_of(graph, report);
  std::vector<std::string> names;
  for (const auto& [name, node] : profiles) names.push_back(name);
  std::vector<const Node*> result;
  for (const auto& [name, position] : wanted_profiles(graph, chosen)) {
    const auto found = profiles.find(name);
    if (found != profiles.end()) {
      result.push_back(found->second);
    } else {
      report_unknown(name, position, names, report);
    }
  }
  return result;
}

}  // namespace

Parts merge_profiles(const Node& graph, const std::vector<std::string>& chosen, Report& report) {
  Parts parts;
  Merger hardware(parts.hardware, report);
  Merger components(parts.components, report);
  Merger connections(parts.connections, report);
  std::vector<const Node*> sections = chosen_profiles(graph, chosen, report);
  sections.insert(sections.begin(), &graph);
  for (const Node* section : sections) {
    for (Merger* merger : {&hardware, &components, &connections}) merger->start_section();
    for (const Node& child : section->children) {
      if (child.is("hardware")) hardware.add(child);
      if (child.is("component")) components.add(child);
      if (child.is("connect")) connections.add(child);
    }
  }
  return parts;
}

}  // namespace orca::graph
