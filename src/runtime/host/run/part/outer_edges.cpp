// SPDX-License-Identifier: LGPL-3.0-or-later
#include "outer_edges.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "orca/base/network_address.hpp"
#include "orca/base/own_library.hpp"
#include "orca/graph/placement.hpp"
#include "run/component_making.hpp"

namespace orca::host {
namespace {

constexpr Duration kPatience = 5s;  // with a network that is cut while this process is started again
constexpr const char* kDdsLibrary = "liborca_dds.so";

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

QueuePolicy policy_of(const graph::Edge& edge) {
  QueuePolicy policy = edge.queue;
  policy.min_interval = edge.interval;
  return policy;
}

}  // namespace

Status OuterEdges::prepare(std::map<std::size_t, Descriptor> memory, PluginCatalogue& catalogue) {
  memory_ = std::move(memory);
  const graph::ProcessPart part = graph::part_of(whole_, process_);
  edges_ = part.edges_out;
  edges_.insert(edges_.end(), part.edges_in.begin(), part.edges_in.end());
  for (const std::size_t edge : edges_) {
    if (memory_.contains(edge) != (whole_.edges[edge].link == graph::Link::shm))
      return fail(Code::data_loss, "the memory does not fit the edges of the graph");
    if (whole_.edges[edge].pattern != Pattern::push) continue;
    if (Status learned = learn(edge, catalogue); !learned.ok()) return learned;
  }
  return ok();
}

// Asks the plugin for the contract of the port that pushes.
Status OuterEdges::learn(std::size_t edge, PluginCatalogue& catalogue) {
  const graph::PortRef& server = whole_.edges[edge].from;
  const graph::ComponentNode& node = *whole_.find_component(server.component);
  const std::optional<graph::HardwareUse> use = hardware_of(whole_, node);
  const Result<Contract> contract = catalogue.component(node.type, use ? &*use : nullptr);
  if (!contract) return contract.error();
  const auto port = std::ranges::find(contract->ports, server.port, [&](const PortContract& declared) {
    return name_in_graph(node, declared.name);
  });
  if (port != contract->ports.end()) servers_.emplace(edge, *port);
  return ok();
}

OuterEdges::Ends OuterEdges::ends_of(const graph::Edge& edge) const {
  return process_of(edge.from) == process_ ? Ends{edge.from, edge.to} : Ends{edge.to, edge.from};
}

const std::string& OuterEdges::process_of(const graph::PortRef& port) const {
  return whole_.find_component(port.component)->process;
}

Status OuterEdges::connect(System& system) {
  for (const std::size_t edge : edges_) {
    const graph::PortRef& here = ends_of(whole_.edges[edge]).here;
    Endpoint* const port = system.endpoint(here);
    if (port == nullptr)
      return fail(Code::internal,
                  "port " + here.text() + " was there when the graph was checked, and is not there now");
    const bool is_client = here == whole_.edges[edge].client();
    if (is_client) prepare_choice(whole_.edges[edge], *port);
    const auto memory = memory_.find(edge);
    const Status connected =
        memory == memory_.end() ? connect_dds(edge, *port) : connect_memory(edge, memory->second, *port);
    if (!connected.ok()) return connected;
    if (is_client) take_first_choice(whole_.edges[edge], *port);
  }
  memory_.clear();
  return ok();
}

Status OuterEdges::connect_memory(std::size_t index, const Descriptor& memory, Endpoint& port) {
  const graph::Edge& edge = whole_.edges[index];
  const graph::PortRef& there = ends_of(edge).there;
  Result<RingSegment> segment = RingSegment::map(memory.number());
  if (!segment) return segment.error();
  ends_[index] = join(port, {std::move(segment).value(),
                             {there.text(), doorbell_(there.component)},
                             policy_of(edge),
                             servers_[index].period});
  return ok();
}

Status OuterEdges::connect_dds(std::size_t index, Endpoint& port) {
  const graph::Edge& edge = whole_.edges[index];
  const graph::PortRef& there = ends_of(edge).there;
  if (dds_ == nullptr) {
    const Result<DdsOptions> options = dds_options();
    if (!options) return options.error();
    Result<std::unique_ptr<DdsBackend>> opened = open_dds(beside_own_library(kDdsLibrary), *options);
    if (!opened) return opened.error();
    dds_ = std::move(opened).value();
  }
  return dds_->connect(port, {there.text(), process_of(there), servers_[index].type.name}, policy_of(edge),
                       servers_[index].period);
}

// With several machines all processes use the network between them, as those of one machine must meet, too.
Result<DdsOptions> OuterEdges::dds_options() const {
  DdsOptions options;
  options.graph = whole_.name;
  options.run = run_;
  options.process = process_;
  if (whole_.machines.size() < 2) return options;
  const auto here = std::ranges::find(whole_.processes, process_, &graph::ProcessNode::name);
  for (const graph::MachineNode& node : whole_.machines) {
    const bool is_here = node.name == here->machine;
    if (!is_here && node.address.empty()) continue;
    Result<std::string> address =
        is_here ? own_address(node.interface, node.address, kPatience) : address_of_host(node.address);
    if (!address) return address.error();
    if (is_here)
      options.address = std::move(address).value();
    else
      options.others.push_back(std::move(address).value());
  }
  return options;
}

void OuterEdges::cut(std::size_t edge, const Error& reason) {
  if (const auto end = ends_.find(edge); end != ends_.end()) return end->second->cut(reason);
  if (dds_ != nullptr && edge < whole_.edges.size())
    dds_->cut(process_of(ends_of(whole_.edges[edge]).there), reason);
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
