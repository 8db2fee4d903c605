// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <set>
#include <string>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"
#include "reading/naming.hpp"
#include "reading/values.hpp"

namespace orca::graph {
namespace {

// One name on the command line of orcactl must not mean two things.
void check_not_a_component(const Node& node, const Model& model, Report& report) {
  const CheckedComponent* const other = model.component(node.value("name"));
  if (other == nullptr) return;
  report.error(codes::kDuplicateName, node.place("name"),
               "the name of " + node.title() + " is taken already by the component at " +
                   other->value.position.text() + "; give the group another one");
}

void check_members(const Node& node, const std::vector<std::string>& names, const Model& model,
                   Report& report) {
  const xml::Position& place = node.place("components");
  if (names.empty())
    report.error(codes::kGroup, place,
                 node.title() + " has no components; name at least one, or remove the group");
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(name).second) {
      report.error(codes::kGroup, place,
                   node.title() + ": components names " + in_quotes(name) + " twice; name it once");
    } else {
      check_component_exists(name, place, node.title() + ": components", model, report);
    }
  }
}

}  // namespace

std::vector<GroupNode> check_groups(const std::vector<Node>& nodes, const Model& model, Report& report) {
  std::vector<GroupNode> groups;
  for (const Node& node : nodes) {
    const std::vector<std::string> names = split_names(node.value("components"));
    check_name(node, "name", report);
    check_not_a_component(node, model, report);
    if (node.known("components") != nullptr) check_members(node, names, model, report);
    groups.push_back({node.value("name"), names, node.position});
  }
  return groups;
}

}  // namespace orca::graph
