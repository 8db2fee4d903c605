// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rewiring.hpp"

#include <utility>

#include "orca/patterns/local/local_links.hpp"
#include "run/component_making.hpp"

namespace orca::host {

Status rewire(System& system, const graph::Edge& edge, bool makes, Event& changed, TimePoint deadline) {
  Endpoint* const from = system.endpoint(edge.from);
  Endpoint* const to = system.endpoint(edge.to);
  for (const auto& [port, ref] : {std::pair(from, &edge.from), std::pair(to, &edge.to)})
    if (port == nullptr) return fail(Code::not_found, "there is no port " + ref->text() + " in this process");
  return system.on_strand(edge.client().component, changed, deadline, [=] {
    if (makes) return LocalLinks().renew(*from, *to, policy_of(edge));
    const bool pushes = edge.pattern == Pattern::push;
    Links::leave(pushes ? *to : *from, edge.server().text());
    Links::leave(pushes ? *from : *to, edge.client().text());
    return ok();
  });
}

Status move(const System& system, const graph::Edge& edge) {
  auto* const client = dynamic_cast<MovablePort*>(system.endpoint(edge.client()));
  if (client != nullptr && client->move_to(edge.server().text())) return ok();
  return fail(Code::not_found, edge.client().text() + " has no choice of " + edge.server().text());
}

}  // namespace orca::host
