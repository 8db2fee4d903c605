// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/links.hpp"

#include <string>

namespace orca {
namespace {

Error mismatch(const Endpoint& from, const Endpoint& to) {
  const auto describe = [](const Endpoint& end) {
    return end.path() + " (" + to_string(end.contract().pattern) + to_string(end.contract().role) + " of " +
           end.contract().type.name + ")";
  };
  return fail(Code::invalid_argument, "cannot connect " + describe(from) + " to " + describe(to));
}

// Objects go from `from` to `to`, replies the other way.
bool fits(const PortContract& from, const PortContract& to) {
  const Role starts = from.pattern == Pattern::push ? Role::server : Role::proxy;
  const bool replies_fit = from.reply && to.reply ? is_a(*to.reply, *from.reply) : from.reply == to.reply;
  return from.pattern == to.pattern && from.role == starts && to.role != starts && is_a(from.type, to.type) &&
         replies_fit;
}

template <class Client>
Status check_free(const Client& client) {
  if (!client.connected() || client.contract().many || client.can_move()) return ok();
  return fail(Code::already_exists, client.path() + " is connected already");
}

// Checks that the proxy of two ends that fit each other is free.
Status check_free(const Endpoint& from, const Endpoint& to) {
  switch (from.contract().pattern) {
    case Pattern::push: return check_free(static_cast<const PushClientEndpoint&>(to));
    case Pattern::query: return check_free(static_cast<const QueryClientEndpoint&>(from));
    default: return check_free(static_cast<const SendClientEndpoint&>(from));
  }
}

}  // namespace

Status Links::check_fit(const Endpoint& from, const Endpoint& to, const QueuePolicy& policy) {
  if (!fits(from.contract(), to.contract())) return mismatch(from, to);
  if (policy.overflow == QueuePolicy::Overflow::block && from.contract().from_device)
    return fail(
        Code::invalid_argument,
        "an edge from " + from.path() + " cannot block, because a device pushes there and waits for nobody");
  return ok();
}

Status Links::connect(Endpoint& from, Endpoint& to, const QueuePolicy& policy) {
  if (Status fits = check_fit(from, to, policy); !fits.ok()) return fits;
  if (Status free = check_free(from, to); !free.ok()) return free;
  join(from, to, policy);
  return ok();
}

void Links::join(Endpoint& from, Endpoint& to, const QueuePolicy& policy) {
  switch (from.contract().pattern) {
    case Pattern::push:
      return push(static_cast<PushServerEndpoint&>(from), static_cast<PushClientEndpoint&>(to), policy);
    case Pattern::query:
      return query(static_cast<QueryClientEndpoint&>(from), static_cast<QueryServerEndpoint&>(to));
    default:
      return send(static_cast<SendClientEndpoint&>(from), static_cast<SendServerEndpoint&>(to), policy);
  }
}

// The end of a link uses the server's edge, and a client uses the end of its link: what uses the other goes first.
void Links::leave(Endpoint& port, const std::string& peer) {
  const bool serves = port.contract().role == Role::server;
  if (serves) port.cut_link(peer);
  const auto disconnect = [&]<class Port>(Port* of_kind) {
    if (of_kind != nullptr) of_kind->disconnect(peer);
  };
  disconnect(dynamic_cast<PushServerEndpoint*>(&port));
  disconnect(dynamic_cast<PushClientEndpoint*>(&port));
  disconnect(dynamic_cast<QueryServerEndpoint*>(&port));
  disconnect(dynamic_cast<QueryClientEndpoint*>(&port));
  disconnect(dynamic_cast<SendServerEndpoint*>(&port));
  disconnect(dynamic_cast<SendClientEndpoint*>(&port));
  if (!serves) port.cut_link(peer);
}

}  // namespace orca
