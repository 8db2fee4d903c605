// SPDX-License-Identifier: LGPL-3.0-or-later
#include "backdrop.hpp"

#include "orca/patterns/endpoints/push_server_endpoint.hpp"
#include "orca/patterns/endpoints/query_server_endpoint.hpp"
#include "orca/patterns/endpoints/send_server_endpoint.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "run/system/component_making.hpp"
#include "run/system/topics.hpp"

namespace orca::host {
namespace {

// Why a peer in the backdrop takes and answers nothing.
constexpr const char* kUnheard = "in an exchange, what the object says that does not work reaches nobody";

}  // namespace

void Backdrop::keep_places(const ComponentInstance& running, const ComponentInstance& object) {
  for (const PortContract& contract : object.parts().ports.contracts()) {
    if (!contract.many) continue;
    auto* const own = dynamic_cast<PushClientEndpoint*>(object.endpoint(contract.name));
    const auto* const present = dynamic_cast<PushClientEndpoint*>(running.endpoint(contract.name));
    if (own != nullptr && present != nullptr) own->take_places_of(*present);
  }
}

Status Backdrop::connect(const graph::Graph& graph, ComponentInstance& object, TrialServers* servers) {
  for (const graph::Edge& edge : graph.edges) {
    const bool comes_from = edge.from.component == object.name();
    if (!comes_from && edge.to.component != object.name()) continue;
    Endpoint* const own = object.endpoint(comes_from ? edge.from.port : edge.to.port);
    if (own == nullptr) continue;
    const bool is_client = (edge.pattern == Pattern::push) != comes_from;
    if (is_client) prepare_choice(edge, *own);
    if (is_client && servers != nullptr && edge.pattern != Pattern::push) {
      servers->connect(edge, *own);
    } else if (Status connected = connect(edge, comes_from, *own); !connected.ok()) {
      return connected;
    }
    if (is_client) take_first_choice(edge, *own);
  }
  const graph::ComponentNode* const node = graph.find_component(object.name());
  return node == nullptr ? ok() : connect_silence(*node, object);
}

// Connects the object's end of an edge with a port of a peer.
Status Backdrop::connect(const graph::Edge& edge, bool comes_from, Endpoint& own) {
  Endpoint& other = *counterpart(comes_from ? edge.to : edge.from, own);
  QueuePolicy policy = policy_of(edge);
  if (edge.pattern == Pattern::push && policy.overflow == QueuePolicy::Overflow::block)
    policy.overflow = QueuePolicy::Overflow::drop_newest;  // a peer here has no strand that could wait
  LocalLinks links;
  return links.connect(comes_from ? own : other, comes_from ? other : own, policy);
}

void Backdrop::push(const graph::PortRef& from, ObjectRef object) {
  const auto peer = peers_.find(from.component);
  if (peer == peers_.end()) return;
  auto* const port = dynamic_cast<PushServerEndpoint*>(peer->second->ports.find(from.port));
  if (port != nullptr) port->publish(std::move(object));
}

// Makes a port at which a connection of the object's port can end.
Endpoint* Backdrop::counterpart(const graph::PortRef& ref, const Endpoint& of) {
  std::unique_ptr<Peer>& peer = peers_[ref.component];
  if (peer == nullptr) peer = std::make_unique<Peer>(executive_, ref.component);
  if (Endpoint* const known = peer->ports.find(ref.port)) return known;
  PortContract contract = of.contract();
  contract.name = ref.port;
  contract.role = contract.role == Role::server ? Role::proxy : Role::server;
  contract.many = contract.role == Role::proxy;  // whatever the real one takes
  peer->ports.add(contract);
  Endpoint* const made = peer->ports.find(ref.port);
  if (auto* const server = dynamic_cast<SendServerEndpoint*>(made)) server->close(kUnheard);
  if (auto* const server = dynamic_cast<QueryServerEndpoint*>(made)) server->close(kUnheard);
  return made;
}

}  // namespace orca::host
