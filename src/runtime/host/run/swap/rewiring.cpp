// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rewiring.hpp"

#include <utility>

#include "run/system/component_making.hpp"

namespace orca::host {

Error no_such(const graph::PortRef& port) {
  return fail(Code::not_found, "there is no port " + port.text() + " in this process");
}

Result<Rewiring> rewiring_of(const System& system, const graph::Edge& edge, bool makes, LocalLinks links) {
  Endpoint* const from = system.endpoint(edge.from);
  Endpoint* const to = system.endpoint(edge.to);
  for (const auto& [port, ref] : {std::pair(from, &edge.from), std::pair(to, &edge.to)})
    if (port == nullptr) return no_such(*ref);
  const std::string& client = edge.client().component;
  const QueuePolicy policy = policy_of(edge);
  if (makes) {
    if (Status fits = LocalLinks::check_fit(*from, *to, policy); !fits.ok()) return fits.error();
    return Rewiring{client, [=]() mutable { return links.renew(*from, *to, policy); }};
  }
  const bool pushes = edge.pattern == Pattern::push;
  return Rewiring{client, [pushes, from, to, server = edge.server().text(), path = edge.client().text()] {
                    Links::leave(pushes ? *to : *from, server);
                    Links::leave(pushes ? *from : *to, path);
                    return ok();
                  }};
}

Status move(const System& system, const graph::Edge& edge) {
  auto* const client = dynamic_cast<MovablePort*>(system.endpoint(edge.client()));
  if (client != nullptr && client->move_to(edge.server().text())) return ok();
  return fail(Code::not_found, edge.client().text() + " has no choice of " + edge.server().text());
}

}  // namespace orca::host
