// SPDX-License-Identifier: LGPL-3.0-or-later
#include "clashes.hpp"

#include <algorithm>
#include <set>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"

namespace orca::graph {
namespace {

// Returns the origins of a node, the outermost first.
std::vector<const Origin*> way_of(const Node& node) {
  std::vector<const Origin*> way;
  for (const Origin* at = node.origin; at != nullptr; at = at->parent) way.push_back(at);
  std::ranges::reverse(way);
  return way;
}

std::string ends_of(const Node& node) {
  const std::string from = node.value("from");
  const std::string to = node.value("to");
  if (node.find("seek") != nullptr) return "that " + in_quotes(from.empty() ? to : from) + " seeks";
  return "from " + in_quotes(from) + " to " + in_quotes(to);
}

std::string component_of(const std::string& end) { return end.substr(0, end.rfind('.')); }

}  // namespace

Clashes::Cause Clashes::cause_of(const Node& node, const Node& first) {
  const std::vector<const Origin*> a = way_of(node);
  const std::vector<const Origin*> b = way_of(first);
  const auto [end_a, end_b] = std::ranges::mismatch(a, b);
  return {end_a == a.end() ? nullptr : *end_a, end_b == b.end() ? nullptr : *end_b};
}

void Clashes::add(const Node& node, const Node& first) {
  const Cause cause = cause_of(node, first);
  const auto [found, fresh] = index_.try_emplace(cause, groups_.size());
  if (fresh) groups_.push_back({cause, {}});
  groups_[found->second].second.push_back({&node, &first});
}

void Clashes::report(Report& report) const {
  for (const auto& [cause, group] : groups_) report_group(cause, group, report);
}

void Clashes::report_one(const Clash& clash, Report& report) {
  const Node& node = *clash.node;
  const std::string here = node.origin == nullptr ? "" : " (included at " + node.origin->text() + ")";
  const std::string first = clash.first->whereabouts();
  if (node.is("connect")) {
    report.error(codes::kDuplicateEdge, node.position,
                 "the connection " + ends_of(node) + here + " exists already at " + first);
  } else {
    report.error(codes::kDuplicateName, node.place("name"),
                 "the name of " + node.title() + here + " is taken already at " + first);
  }
}

void Clashes::report_group(const Cause& cause, const std::vector<Clash>& group, Report& report) {
  std::set<std::string> taken;
  for (const auto& [node, first] : group)
    if (!node->is("connect")) taken.insert(node->value("name"));
  const bool one_cause = taken.size() > 1 && (cause.first != nullptr || cause.second != nullptr);
  // Two connections between the same names are a consequence of these clashes.
  const auto follows = [&](const Node& node) {
    return node.is("connect") && (taken.contains(component_of(node.value("from"))) ||
                                  taken.contains(component_of(node.value("to"))));
  };
  for (const Clash& clash : group) {
    const bool gathered = one_cause && !clash.node->is("connect");
    if (!gathered && !(cause != Cause{} && follows(*clash.node))) report_one(clash, report);
  }
  if (one_cause) report_bringer(cause, group, report);
}

void Clashes::report_bringer(const Cause& cause, const std::vector<Clash>& group, Report& report) {
  const Origin& bringer = cause.first != nullptr ? *cause.first : *cause.second;
  const bool both_brought = cause.first != nullptr && cause.second != nullptr;
  std::vector<std::string> names;
  for (const auto& [node, first] : group) {
    if (node->is("connect")) continue;
    const Node& other = cause.first != nullptr ? *first : *node;
    names.push_back(node->title() + (both_brought ? "" : " at " + other.whereabouts()));
  }
  const std::string by =
      both_brought ? " by the <" + std::string(cause.second->bringer->name) + "> at " + cause.second->text()
                   : "";
  const bool use = bringer.bringer->name == "use";
  report.error(codes::kDuplicateName, bringer.position,
               "<" + std::string(bringer.bringer->name) + "> brings " + std::to_string(names.size()) +
                   " names that are taken already" + by + ": " + listed(names) +
                   (use ? "; give it another prefix" : "; leave it out, or rename them"));
}

}  // namespace orca::graph
