// SPDX-License-Identifier: LGPL-3.0-or-later
#include "port_set.hpp"

#include <algorithm>
#include <utility>

namespace orca::host {

bool same_port(const PortContract& a, const PortContract& b) {
  return a.name == b.name && a.pattern == b.pattern && a.role == b.role && a.type == b.type &&
         a.reply == b.reply && a.many == b.many;
}

template <class Kind>
Kind& PortSet::make(const PortContract& contract) {
  auto endpoint = std::make_unique<Kind>(home_, contract);
  Kind& made = *endpoint;
  endpoints_.push_back(std::move(endpoint));
  return made;
}

void PortSet::add(const PortContract& contract) {
  const std::lock_guard lock(mutex_);
  const bool server = contract.role == Role::server;
  if (contract.pattern == Pattern::push && server) {
    push_servers_.push_back(&make<PushServerEndpoint>(contract));
  } else if (contract.pattern == Pattern::push) {
    push_clients_.push_back(&make<PushClientEndpoint>(contract));
  } else if (contract.pattern == Pattern::send && server) {
    send_servers_.push_back({&make<SendServerEndpoint>(contract), {}});
  } else if (contract.pattern == Pattern::send) {
    make<SendClientEndpoint>(contract);
  } else if (server) {
    query_servers_.push_back({&make<QueryServerEndpoint>(contract), {}});
  } else {
    make<QueryClientEndpoint>(contract);
  }
}

Endpoint* PortSet::find(const std::string& port) const {
  const std::lock_guard lock(mutex_);
  for (const auto& endpoint : endpoints_)
    if (endpoint->contract().name == port) return endpoint.get();
  return nullptr;
}

std::vector<PortContract> PortSet::contracts() const {
  const std::lock_guard lock(mutex_);
  std::vector<PortContract> contracts;
  for (const auto& endpoint : endpoints_) contracts.push_back(endpoint->contract());
  return contracts;
}

Status PortSet::bind(const std::vector<PortDeclaration>& declarations) {
  for (const PortDeclaration& declaration : declarations) {
    Endpoint* const endpoint = find(declaration.contract.name);
    if (endpoint == nullptr || !same_port(endpoint->contract(), declaration.contract))
      return fail(Code::failed_precondition,
                  "its port \"" + declaration.contract.name +
                      "\" is not as it was when the graph was checked; was the plugin exchanged meanwhile?");
    *declaration.slot = endpoint;
    bind_handler(declaration);
  }
  return ok();
}

void PortSet::bind_handler(const PortDeclaration& declaration) {
  const auto is_it = [&](const auto& intake) {
    return intake.endpoint->contract().name == declaration.contract.name;
  };
  for (auto& intake : send_servers_)
    if (is_it(intake)) intake.handler = declaration.on_object;
  for (auto& intake : query_servers_)
    if (is_it(intake)) intake.handler = declaration.on_request;
  for (PushClientEndpoint* client : push_clients_)
    if (!declaration.manual && client->contract().name == declaration.contract.name)
      automatic_clients_.push_back(client);
}

void PortSet::unbind() {
  for (auto& intake : send_servers_) intake.handler = nullptr;
  for (auto& intake : query_servers_) intake.handler = nullptr;
  automatic_clients_.clear();
}

void PortSet::open() {
  for (const auto& intake : send_servers_) intake.endpoint->open(intake.handler);
  for (const auto& intake : query_servers_) intake.endpoint->open(intake.handler);
}

void PortSet::hold() {
  const Error never = fail(Code::internal, "handled by nobody");
  for (const auto& intake : send_servers_) intake.endpoint->open([never](const auto&) { return never; });
  for (const auto& intake : query_servers_) intake.endpoint->open([never](const auto&) { return never; });
}

void PortSet::close(const std::string& reason) {
  for (const auto& intake : send_servers_) intake.endpoint->close(reason);
  for (const auto& intake : query_servers_) intake.endpoint->close(reason);
}

bool PortSet::has_intake() const {
  const auto waits = [](const auto& intake) { return intake.endpoint->has_waiting(); };
  return std::any_of(send_servers_.begin(), send_servers_.end(), waits) ||
         std::any_of(query_servers_.begin(), query_servers_.end(), waits);
}

bool PortSet::is_asked() const {
  const std::lock_guard lock(mutex_);
  return has_intake();
}

bool PortSet::has_subscribers() const {
  return std::any_of(push_servers_.begin(), push_servers_.end(),
                     [](const PushServerEndpoint* server) { return server->subscriber_count() > 0; });
}

bool PortSet::has_audience() const {
  return std::any_of(push_servers_.begin(), push_servers_.end(),
                     [](const PushServerEndpoint* server) { return server->audience() > 0; });
}

void PortSet::subscribe() {
  for (PushClientEndpoint* client : automatic_clients_) client->subscribe_all();
}

void PortSet::unsubscribe() {
  for (PushClientEndpoint* client : push_clients_) client->unsubscribe_all();
}

bool PortSet::has_deadline() const {
  return std::any_of(push_clients_.begin(), push_clients_.end(),
                     [](const PushClientEndpoint* client) { return client->has_deadline(); });
}

TimePoint PortSet::watch_deadlines() {
  TimePoint next = kForever;
  for (PushClientEndpoint* client : push_clients_) next = std::min(next, client->watch_deadlines());
  return next;
}

}  // namespace orca::host
