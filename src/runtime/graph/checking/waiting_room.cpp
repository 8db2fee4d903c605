// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <algorithm>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"

namespace orca::graph {
namespace {

bool waits_for_others(const CheckedComponent& component, const std::string& port) {
  const auto& trigger = component.value.trigger;
  return trigger && trigger->kind == Trigger::Kind::on_stamps &&
         std::ranges::find(trigger->ports, port) != trigger->ports.end();
}

}  // namespace

void check_waiting_room(const Model& model, const std::vector<Edge>& edges, Report& report) {
  for (const Edge& edge : edges) {
    const CheckedComponent* const component = model.component(edge.to.component);
    if (edge.queue.depth > 1 || component == nullptr || !waits_for_others(*component, edge.to.port)) continue;
    report.error(
        codes::kPolicy, edge.position,
        "the connection from " + in_quotes(edge.from.text()) + " to " + in_quotes(edge.to.text()) +
            " keeps one object, and the next one replaces it before those of the same moment have come "
            "to the other ports of " +
            in_quotes(edge.to.component) + " (fuse=\"stamps\"); give it room, for example queue=\"4\"");
  }
}

}  // namespace orca::graph
