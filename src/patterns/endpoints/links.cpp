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
  Status possible = check_fit(from, to, policy);
  if (!possible.ok()) return possible;
  if (from.contract().pattern == Pattern::push) {
    auto& client = static_cast<PushClientEndpoint&>(to);
    possible = check_free(client);
    if (possible.ok()) push(static_cast<PushServerEndpoint&>(from), client, policy);
  } else if (from.contract().pattern == Pattern::send) {
    auto& client = static_cast<SendClientEndpoint&>(from);
    possible = check_free(client);
    if (possible.ok()) send(client, static_cast<SendServerEndpoint&>(to), policy);
  } else {
    auto& client = static_cast<QueryClientEndpoint&>(from);
    possible = check_free(client);
    if (possible.ok()) query(client, static_cast<QueryServerEndpoint&>(to));
  }
  return possible;
}

void Links::leave(Endpoint& port, const std::string& peer) {
  if (auto* const server = dynamic_cast<PushServerEndpoint*>(&port)) {
    server->cut_link(peer);  // ends the subscription
    return server->disconnect(peer);
  }
  if (auto* const push = dynamic_cast<PushClientEndpoint*>(&port)) push->disconnect(peer);
  if (auto* const asker = dynamic_cast<QueryClientEndpoint*>(&port)) asker->disconnect(peer);
  if (auto* const sender = dynamic_cast<SendClientEndpoint*>(&port)) sender->disconnect(peer);
  if (auto* const answerer = dynamic_cast<QueryServerEndpoint*>(&port)) answerer->disconnect(peer);
  if (auto* const taker = dynamic_cast<SendServerEndpoint*>(&port)) taker->disconnect(peer);
  port.cut_link(peer);
}

}  // namespace orca
