// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <algorithm>
#include <optional>

#include "reading/codes.hpp"
#include "reading/values.hpp"

namespace orca::graph {
namespace {

// Returns the file of the other graph; nothing after a report, or if there has been one.
std::optional<std::string> file_of(const Node& node, Report& report) {
  const Text* const name = node.known("graph");
  if (name == nullptr) return std::nullopt;
  if (!name->value.empty()) return resolved_path(name->value, *name);
  report.error(codes::kChange, name->position,
               "<change>: graph is empty; name a graph file, as in graph=\"with_vfh.xml\"");
  return std::nullopt;
}

// A change names a graph of the whole system, which a part of it that is used under a prefix does not know.
void check_is_of_whole(const Node& node, Report& report) {
  if (node.context.empty()) return;
  report.error(codes::kChange, node.position,
               "<change> is in a graph that is used under the prefix \"" +
                   node.context.substr(0, node.context.size() - 1) +
                   "\", but names a graph of the whole system; put it into the main graph");
}

}  // namespace

std::vector<PlannedChange> check_changes(const std::vector<Node>& nodes, Report& report) {
  std::vector<PlannedChange> changes;
  for (const Node& node : nodes) {
    check_is_of_whole(node, report);
    const std::optional<std::string> file = file_of(node, report);
    const auto at = read_attribute<double>(node, "at", report);
    if (file) changes.push_back({*file, from_seconds(at.value_or(0.0)), node.position});
  }
  std::ranges::stable_sort(changes, {}, &PlannedChange::at);
  return changes;
}

}  // namespace orca::graph
