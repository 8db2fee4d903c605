// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/local/local_link.hpp"

#include "orca/patterns/push_endpoint.hpp"
#include "orca/patterns/query_endpoint.hpp"
#include "orca/patterns/send_endpoint.hpp"

namespace orca {
namespace {

Error mismatch(const Endpoint& from, const Endpoint& to) {
  const auto describe = [](const Endpoint& end) {
    return end.path() + " (" + to_string(end.contract().pattern) + to_string(end.contract().role) + " of " +
           end.contract().type.name + ")";
  };
  return fail(Code::invalid_argument, "cannot connect " + describe(from) + " to " + describe(to));
}

Error taken(const Endpoint& proxy) {
  return fail(Code::already_exists, proxy.path() + " is connected already");
}

bool fits(const PortContract& from, const PortContract& to) {
  const Role starts = from.pattern == Pattern::push ? Role::server : Role::proxy;
  return from.pattern == to.pattern && from.role == starts && to.role != starts && from.type == to.type &&
         from.reply == to.reply;
}

Status connect_send(SendClientEndpoint& proxy, SendServerEndpoint& server, const QueuePolicy& policy) {
  if (proxy.connected()) return taken(proxy);
  proxy.connect(server.connect(proxy.path(), policy));
  return ok();
}

Status connect_query(QueryClientEndpoint& proxy, QueryServerEndpoint& server) {
  if (proxy.connected()) return taken(proxy);
  proxy.connect(server);
  return ok();
}

Status connect_push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) {
  if (client.connected() && !client.contract().many) return taken(client);
  if (policy.overflow == QueuePolicy::Overflow::block && server.contract().from_device)
    return fail(Code::invalid_argument,
                "an edge from " + server.path() +
                    " cannot block, because a device pushes there and waits for nobody");
  client.connect(server.source(), policy);
  return ok();
}

}  // namespace

Status connect_locally(Endpoint& from, Endpoint& to, const QueuePolicy& policy) {
  if (!fits(from.contract(), to.contract())) return mismatch(from, to);
  switch (from.contract().pattern) {
    case Pattern::push:
      return connect_push(static_cast<PushServerEndpoint&>(from), static_cast<PushClientEndpoint&>(to),
                          policy);
    case Pattern::send:
      return connect_send(static_cast<SendClientEndpoint&>(from), static_cast<SendServerEndpoint&>(to),
                          policy);
    case Pattern::query:
      return connect_query(static_cast<QueryClientEndpoint&>(from), static_cast<QueryServerEndpoint&>(to));
  }
  return mismatch(from, to);
}

Status connect_locally(Endpoint& from, Endpoint& to) {
  return connect_locally(from, to, to.contract().queue);
}

}  // namespace orca
