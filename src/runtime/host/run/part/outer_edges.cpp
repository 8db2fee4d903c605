// SPDX-License-Identifier: LGPL-3.0-or-later
#include "outer_edges.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace orca::host {
namespace {

// An edge at this process, whose end here is `port`.
struct Joint {
  RingSegment segment;
  ShmPeer peer;
  QueuePolicy policy;
  Duration base_period;  // of the server of Push
};

// Makes the end of the link that serves the port.
ShmEnd* join(Endpoint& port, Joint joint) {
  if (auto* server = dynamic_cast<PushServerEndpoint*>(&port))
    return &make_shm_end(*server, std::move(joint.segment), std::move(joint.peer), joint.policy);
  if (auto* client = dynamic_cast<PushClientEndpoint*>(&port))
    return &make_shm_end(*client, std::move(joint.segment), std::move(joint.peer), joint.policy,
                         joint.base_period);
  if (auto* server = dynamic_cast<QueryServerEndpoint*>(&port))
    return &make_shm_end(*server, std::move(joint.segment), std::move(joint.peer));
  if (auto* client = dynamic_cast<QueryClientEndpoint*>(&port))
    return &make_shm_end(*client, std::move(joint.segment), std::move(joint.peer));
  if (auto* server = dynamic_cast<SendServerEndpoint*>(&port))
    return &make_shm_end(*server, std::move(joint.segment), std::move(joint.peer), joint.policy);
  if (auto* client = dynamic_cast<SendClientEndpoint*>(&port))
    return &make_shm_end(*client, std::move(joint.segment), std::move(joint.peer), joint.policy);
  return nullptr;
}

std::optional<graph::HardwareUse> hardware_of(const graph::Graph& graph, const graph::ComponentNode& node) {
  const graph::HardwareNode* const hardware = graph.find_hardware(node.hardware);
  if (hardware == nullptr) return std::nullopt;
  return graph::HardwareUse{hardware->name, hardware->type, hardware->params};
}

// Returns the name in the graph of a port that its author calls `name`.
std::string name_in_graph(const graph::ComponentNode& node, const std::string& name) {
  const auto setting = node.ports.find(name);
  return setting == node.ports.end() || setting->second.alias.empty() ? name : setting->second.alias;
}

}  // namespace

Status OuterEdges::prepare(std::map<std::size_t, Descriptor> memory, PluginCatalogue& catalogue) {
  memory_ = std::move(memory);
  for (const auto& [edge, unused] : memory_) {
    if (edge >= whole_.edges.size()) return fail(Code::data_loss, "an edge that the graph does not have");
    if (whole_.edges[edge].pattern != Pattern::push) continue;
    const Result<Duration> period = period_of(whole_.edges[edge].from, catalogue);
    if (!period) return period.error();
    base_periods_[edge] = *period;
  }
  return ok();
}

Result<Duration> OuterEdges::period_of(const graph::PortRef& server, PluginCatalogue& catalogue) const {
  const graph::ComponentNode& node = *whole_.find_component(server.component);
  const std::optional<graph::HardwareUse> use = hardware_of(whole_, node);
  const Result<Contract> contract = catalogue.component(node.type, use ? &*use : nullptr);
  if (!contract) return contract.error();
  const auto port = std::ranges::find(contract->ports, server.port, [&](const PortContract& declared) {
    return name_in_graph(node, declared.name);
  });
  return port == contract->ports.end() ? Duration{0} : port->period;
}

Status OuterEdges::connect(System& system) {
  for (const auto& [edge, memory] : memory_)
    if (Status connected = connect(edge, memory, system); !connected.ok()) return connected;
  memory_.clear();
  return ok();
}

Status OuterEdges::connect(std::size_t index, const Descriptor& memory, System& system) {
  const graph::Edge& edge = whole_.edges[index];
  const bool is_here = system.component(edge.from.component) != nullptr;
  const graph::PortRef& here = is_here ? edge.from : edge.to;
  const graph::PortRef& there = is_here ? edge.to : edge.from;
  Endpoint* const port = system.endpoint(here);
  if (port == nullptr)
    return fail(Code::internal,
                "port " + here.text() + " was there when the graph was checked, and is not there now");
  Result<RingSegment> segment = RingSegment::map(memory.number());
  if (!segment) return segment.error();
  QueuePolicy policy = edge.queue;
  policy.min_interval = edge.interval;
  ends_[index] = join(
      *port,
      {std::move(segment).value(), {there.text(), doorbell_(there.component)}, policy, base_periods_[index]});
  return ok();
}

void OuterEdges::cut(std::size_t edge, const Error& reason) {
  if (const auto end = ends_.find(edge); end != ends_.end()) end->second->cut(reason);
}

Status OuterEdges::renew(std::size_t edge, const Descriptor& memory) {
  const auto end = ends_.find(edge);
  if (end == ends_.end()) return fail(Code::not_found, "an edge that this process does not have");
  Result<RingSegment> segment = RingSegment::map(memory.number());
  if (!segment) return segment.error();
  end->second->renew(std::move(segment).value());
  return ok();
}

}  // namespace orca::host
