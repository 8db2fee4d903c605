// SPDX-License-Identifier: GPL-3.0-or-later
#include "peer.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace orca::test {

Peer::Peer(Executive& executive, std::string name, LinkObserver* observer)
    : strand_(executive, {name, 0}), home_{strand_, std::move(name), observer, {}} {
  strand_.set_leave_condition([this] { return leaving_.load(); });
}

void Peer::declare_port(PortDeclaration declaration) {
  const PortContract& contract = declaration.contract;
  const bool server = contract.role == Role::server;
  std::unique_ptr<Endpoint> made;
  if (contract.pattern == Pattern::push && server) {
    auto push = std::make_unique<PushServerEndpoint>(home_, contract);
    push_servers_.push_back(push.get());
    made = std::move(push);
  } else if (contract.pattern == Pattern::push) {
    made = std::make_unique<PushClientEndpoint>(home_, contract);
  } else if (contract.pattern == Pattern::send && server) {
    auto intake = std::make_unique<SendServerEndpoint>(home_, contract);
    send_servers_.push_back({intake.get(), std::move(declaration.on_object)});
    made = std::move(intake);
  } else if (contract.pattern == Pattern::send) {
    made = std::make_unique<SendClientEndpoint>(home_, contract);
  } else if (server) {
    auto intake = std::make_unique<QueryServerEndpoint>(home_, contract);
    query_servers_.push_back({intake.get(), std::move(declaration.on_request)});
    made = std::move(intake);
  } else {
    made = std::make_unique<QueryClientEndpoint>(home_, contract);
  }
  *declaration.slot = made.get();
  endpoints_.push_back(std::move(made));
}

Endpoint& Peer::endpoint(const std::string& port) const {
  for (const auto& endpoint : endpoints_)
    if (endpoint->contract().name == port) return *endpoint;
  throw std::logic_error("the test peer has no port " + port);
}

void Peer::open() {
  for (const auto& intake : send_servers_) intake.endpoint->open(intake.handler);
  for (const auto& intake : query_servers_) intake.endpoint->open(intake.handler);
}

void Peer::close(const std::string& reason) {
  for (const auto& intake : send_servers_) intake.endpoint->close(reason);
  for (const auto& intake : query_servers_) intake.endpoint->close(reason);
}

bool Peer::handle_one() {
  Status outcome;
  for (const auto& intake : send_servers_)
    if (intake.endpoint->handle_one(outcome)) return true;
  for (const auto& intake : query_servers_)
    if (intake.endpoint->handle_one()) return true;
  return false;
}

bool Peer::has_subscribers() const {
  return std::any_of(push_servers_.begin(), push_servers_.end(),
                     [](const auto* server) { return server->subscriber_count() > 0; });
}

void Peer::leave() {
  leaving_ = true;
  strand_.wake();
}

Script::Script(Peer& peer, std::function<void()> body) : peer_(peer) {
  peer_.strand().start([this, run = std::move(body)] {
    try {
      run();
    } catch (const Interrupted&) {
      interrupted_ = true;
    }
    ended_ = true;
  });
}

Script::~Script() {
  peer_.leave();
  peer_.strand().join_until(kForever);
}

bool Script::ends_within(Duration limit) {
  return peer_.strand().join_until(peer_.executive().now() + limit);
}

Service::Service(Peer& peer)
    : script_(peer, [&peer] {
        while (!peer.leaving())
          if (!peer.handle_one()) peer.strand().pause_until(kForever);
        peer.close("its peer has gone");
      }) {
  peer.open();
}

}  // namespace orca::test
