// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/local/local_links.hpp"

#include "delayed_ends.hpp"

namespace orca {
namespace {

// Gives the connection between two ports a policy. Returns false if they are not connected.
bool change(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) {
  PushEdge* const edge = client.edge_from(server.path());
  if (edge != nullptr) edge->set_policy(policy);
  return edge != nullptr;
}

bool change(const SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) {
  return client.connected() && client.server() == server.path() && server.change(client.path(), policy);
}

bool change(Endpoint& from, Endpoint& to, const QueuePolicy& policy) {
  if (from.contract().pattern == Pattern::push)
    return change(static_cast<PushServerEndpoint&>(from), static_cast<PushClientEndpoint&>(to), policy);
  if (from.contract().pattern == Pattern::send)
    return change(static_cast<SendClientEndpoint&>(from), static_cast<SendServerEndpoint&>(to), policy);
  const auto& client = static_cast<QueryClientEndpoint&>(from);
  return client.connected() && client.server() == to.path();
}

}  // namespace

// An earlier connection of the two that the client has left may still be known to both.
Status LocalLinks::renew(Endpoint& from, Endpoint& to, const QueuePolicy& policy) {
  if (Status fits = check_fit(from, to, policy); !fits.ok()) return fits;
  if (change(from, to, policy)) return ok();
  const bool pushes = from.contract().pattern == Pattern::push;
  Endpoint& client = pushes ? to : from;
  Endpoint& server = pushes ? from : to;
  leave(client, server.path());
  leave(server, client.path());
  join(from, to, policy);
  return ok();
}

void LocalLinks::push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) {
  if (takes_time()) return connect_delayed(server, client, policy, {*courier_, delay_});
  client.connect(server.connect(client.path()), policy);
}

void LocalLinks::query(QueryClientEndpoint& client, QueryServerEndpoint& server) {
  if (takes_time()) return connect_delayed(client, server, {*courier_, delay_});
  client.connect(server.connect(client.path()));
}

void LocalLinks::send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) {
  if (takes_time()) return connect_delayed(client, server, policy, {*courier_, delay_});
  client.connect(server.connect(client.path(), policy));
}

}  // namespace orca
