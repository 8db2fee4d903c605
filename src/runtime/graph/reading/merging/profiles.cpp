// SPDX-License-Identifier: LGPL-3.0-or-later
#include "profiles.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "clashes.hpp"
#include "orca/base/text.hpp"
#include "reading/codes.hpp"
#include "reading/naming.hpp"

namespace orca::graph {
namespace {

// Returns what identifies a node: its name, or both ends of a connection; nothing if that is not known. A port seeks once.
std::optional<std::string> identity(const Node& node) {
  if (!node.is("connect"))
    return node.value("name").empty() ? std::nullopt : std::optional(node.value("name"));
  const std::string from = node.value("from");
  const std::string to = node.value("to");
  if (node.find("seek") != nullptr && from.empty() != to.empty()) return from + to + " seeks";
  if (from.empty() || to.empty()) return std::nullopt;
  return from + " to " + to;
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
  if (over.find("period") != nullptr)
    for (const char* name : {"on", "fuse", "within", "at_least_every"}) base.attributes.erase(name);
  if (over.find("on") != nullptr) base.attributes.erase("period");
  for (const auto& [name, text] : over.attributes) base.attributes.insert_or_assign(name, text);
  for (const Node& child : over.children) override_child(base, child);
}

// A merger of sections into the parts of one kind.
class Merger {
 public:
  Merger(std::vector<Node>& nodes, Clashes& clashes) : nodes_(nodes), clashes_(clashes) {}

  void start_section() { section_.clear(); }

  void add(const Node& node) {
    const auto key = identity(node);
    if (!key) return nodes_.push_back(node);
    const auto [first, fresh] = section_.try_emplace(*key, &node);
    if (!fresh) return add_duplicate(node, *first->second);
    const auto [index, is_new] = index_.try_emplace(*key, nodes_.size());
    if (is_new) {
      nodes_.push_back(node);
    } else {
      override_node(nodes_[index->second], node);
    }
  }

 private:
  void add_duplicate(const Node& node, const Node& first) {
    clashes_.add(node, first);
    nodes_.push_back(node);
    nodes_.back().duplicate = true;
  }

  std::vector<Node>& nodes_;
  Clashes& clashes_;
  std::map<std::string, const Node*> section_;  // definitions of the present section
  std::map<std::string, std::size_t> index_;
};

// @param files_missing  the profile may be in one of them
void report_unknown(const std::string& wanted, const xml::Position& position,
                    const std::vector<std::string>& names, bool files_missing, Report& report) {
  const std::string hint = report.hint(wanted, names);
  if (files_missing && hint.empty()) return;
  report.error(codes::kUnknownProfile, position,
               "there is no profile " + in_quotes(wanted) + "; the graph has: " + listed(names) + hint);
}

// Returns the profiles of a graph, in its order. Profiles of one name add up if their files differ.
std::vector<const Node*> profiles_of(const Node& graph, Report& report) {
  std::vector<const Node*> profiles;
  std::map<std::pair<std::string, const Origin*>, xml::Position> seen;
  for (const Node& child : graph.children) {
    const Text* name = child.is("profile") ? child.known("name") : nullptr;
    if (name == nullptr) continue;
    if (const auto fault = name_fault(name->value)) {
      report.error(codes::kBadName, name->position, child.title() + ": " + *fault);
    }
    const auto [first, fresh] = seen.try_emplace({name->value, child.origin}, child.position);
    if (fresh) {
      profiles.push_back(&child);
    } else {
      report.error(codes::kDuplicateName, name->position,
                   "the name of " + child.title() + " is taken already at " + first->second.text());
    }
  }
  return profiles;
}

// Returns the profiles that are asked for, and where.
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

// The chosen profiles, in the order of the choice, then of the graph.
class Choice {
 public:
  Choice(const Assembly& assembly, const std::vector<std::string>& chosen, Report& report)
      : wanted_(wanted_profiles(assembly.graph, chosen)), report_(report) {
    collect_names(assembly.graph);
    const std::vector<const Node*> profiles = profiles_of(assembly.graph, report_);
    for (const auto& [name, position] : wanted_) {
      if (!names_.contains(name)) {
        report_unknown(name, position, {names_.begin(), names_.end()}, assembly.files_missing, report_);
        some_unknown_ = true;
      }
      for (const Node* profile : profiles)
        if (profile->value("name") == name) add(*profile);
    }
  }

  [[nodiscard]] bool some_unknown() const { return some_unknown_; }
  std::vector<const Node*> profiles() && { return std::move(result_); }

 private:
  void collect_names(const Node& parent) {
    for (const Node& child : parent.children) {
      if (!child.is("profile")) continue;
      if (child.known("name") != nullptr) names_.insert(child.value("name"));
      collect_names(child);
    }
  }

  // Adds a profile, with those of the files that it includes.
  void add(const Node& profile) {
    result_.push_back(&profile);
    for (const Node* inner : profiles_of(profile, report_)) {
      const auto is_wanted = [&](const auto& wanted) { return wanted.first == inner->value("name"); };
      if (std::ranges::any_of(wanted_, is_wanted)) add(*inner);
    }
  }

  const std::vector<std::pair<std::string, xml::Position>> wanted_;
  Report& report_;
  std::set<std::string> names_;
  std::vector<const Node*> result_;
  bool some_unknown_ = false;
};

// Collects the parts of profiles that are not among the chosen ones.
void collect_left_out(const Node& parent, const std::vector<const Node*>& chosen, ProfilesByPart& parts) {
  for (const Node& profile : parent.children) {
    if (!profile.is("profile")) continue;
    collect_left_out(profile, chosen, parts);
    if (std::ranges::find(chosen, &profile) != chosen.end()) continue;
    for (const Node& part : profile.children)
      parts[{std::string(part.rule->name), part.value("name")}].insert(profile.value("name"));
  }
}

}  // namespace

Parts merge_profiles(const Assembly& assembly, const std::vector<std::string>& chosen, Report& report) {
  Parts parts;
  Clashes clashes;
  std::map<std::string_view, Merger> mergers{
      {"machine", {parts.machines, clashes}},  {"process", {parts.processes, clashes}},
      {"hardware", {parts.hardware, clashes}}, {"component", {parts.components, clashes}},
      {"group", {parts.groups, clashes}},      {"connect", {parts.connections, clashes}},
      {"change", {parts.changes, clashes}}};
  Choice choice(assembly, chosen, report);
  parts.some_missing = assembly.files_missing || choice.some_unknown();
  std::vector<const Node*> sections = std::move(choice).profiles();
  sections.insert(sections.begin(), &assembly.graph);
  for (const Node* section : sections) {
    for (auto& [element, merger] : mergers) merger.start_section();
    for (const Node& child : section->children)
      if (const auto merger = mergers.find(child.rule->name); merger != mergers.end())
        merger->second.add(child);
  }
  clashes.report(report);
  collect_left_out(assembly.graph, sections, parts.left_out);
  return parts;
}

}  // namespace orca::graph
