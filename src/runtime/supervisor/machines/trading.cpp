// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trading.hpp"

#include <algorithm>
#include <vector>

#include "orca/base/log.hpp"
#include "orca/graph/placement.hpp"

namespace orca::supervisor {

void Trading::look() {
  const auto standings = [this](const std::string& component) { return standing_of(component); };
  for (const host::EdgeChoice::Move& move : choice_.look(standings)) {
    const std::string& client = move.edge->client().component;
    Member* const member = member_of(client, members_);
    if (member == nullptr) continue;  // on another machine, whose supervisor chooses
    log::warning(client, move.text);
    if (member->is_built()) tell(*member, *move.edge);
  }
}

void Trading::brief(const Members& members) const {
  for (const graph::Edge* const edge : choice_.in_use())
    if (Member* const member = member_of(edge->client().component, members)) tell(*member, *edge);
}

host::Standing Trading::standing_of(const std::string& component) const {
  if (member_of(component, members_) != nullptr) return host::standing_of(reports_(component));
  const std::string machine = graph::machine_of(graph_, component);
  const std::vector<std::string> missing =
      neighbours_ ? neighbours_->gathering().missing() : std::vector<std::string>{};
  const bool is_missing = std::ranges::find(missing, machine) != missing.end();
  if (is_missing) return {false, "is down: machine " + machine + " is not there"};
  return {};
}

Member* Trading::member_of(const std::string& component, const Members& members) const {
  const std::string& process = graph_.find_component(component)->process;
  const auto member = std::ranges::find(members, process, [](const Member* m) { return m->name(); });
  return member == members.end() ? nullptr : *member;
}

void Trading::tell(Member& member, const graph::Edge& edge) { member.tell(MoveEdge{edge.name()}); }

}  // namespace orca::supervisor
