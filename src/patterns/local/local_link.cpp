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

template <class Proxy>
Status connect_proxy(Proxy& proxy, Endpoint& server_end) {
  if (proxy.connected()) return taken(proxy);
  if constexpr (std::is_same_v<Proxy, SendClientEndpoint>) {
    proxy.connect(static_cast<SendServerEndpoint&>(server_end));
  } else {
    proxy.connect(static_cast<QueryServerEndpoint&>(server_end));
  }
  return ok();
}

Status connect_push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) {
  if (client.connected() && !client.contract().many) return taken(client);
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
    case Pattern::send: return connect_proxy(static_cast<SendClientEndpoint&>(from), to);
    case Pattern::query: return connect_proxy(static_cast<QueryClientEndpoint&>(from), to);
  }
  return mismatch(from, to);
}

}  // namespace orca
