// SPDX-License-Identifier: LGPL-3.0-or-later
#include "outer_edges.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "orca/base/files/key_folder.hpp"
#include "orca/base/network_address.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "run/system/component_making.hpp"

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

OuterEdges::OuterEdges(const graph::Graph& whole, std::string process, Doorbell doorbell, std::string run,
                       ClockAhead clock_ahead, std::function<Reporter&()> reporter, PartListener& listener)
    : whole_(whole),
      process_(std::move(process)),
      doorbell_(std::move(doorbell)),
      run_(std::move(run)),
      clock_ahead_(std::move(clock_ahead)),
      damaged_(std::move(reporter), listener) {
  for (const graph::ComponentNode& node : whole.components) learn(node);
}

void OuterEdges::learn(const graph::ComponentNode& component) {
  const MutexLock lock(mutex_);
  processes_[component.name] = component.process;
}

Status OuterEdges::prepare(std::map<std::string, Descriptor> memory, PluginCatalogue& catalogue) {
  memory_ = std::move(memory);
  const graph::ProcessPart part = graph::part_of(whole_, process_);
  for (const std::size_t index : part.edges_out) edges_.push_back(whole_.edges[index]);
  for (const std::size_t index : part.edges_in) edges_.push_back(whole_.edges[index]);
  for (const graph::Edge& edge : edges_) {
    if (memory_.contains(edge.name()) != (edge.link == graph::Link::shm))
      return fail(Code::data_loss, "the memory does not fit the edges of the graph");
    if (edge.pattern != Pattern::push) continue;
    if (Status learned = learn(edge, catalogue); !learned.ok()) return learned;
  }
  return ok();
}

// Asks the plugin for the contract of the port that pushes.
Status OuterEdges::learn(const graph::Edge& edge, PluginCatalogue& catalogue) {
  const graph::PortRef& server = edge.from;
  const graph::ComponentNode& node = *whole_.find_component(server.component);
  const std::optional<graph::HardwareUse> use = hardware_of(whole_, node);
  const Result<Contract> contract = catalogue.component(node.type, use ? &*use : nullptr);
  if (!contract) return contract.error();
  const auto port = std::ranges::find(contract->ports, server.port, [&](const PortContract& declared) {
    return name_in_graph(node, declared.name);
  });
  if (port != contract->ports.end()) servers_.emplace(edge.name(), *port);
  return ok();
}

OuterEdges::Ends OuterEdges::ends_of(const graph::Edge& edge) {
  return process_of(edge.from) == process_ ? Ends{edge.from, edge.to} : Ends{edge.to, edge.from};
}

const std::string& OuterEdges::process_of(const graph::PortRef& port) {
  static const std::string nowhere;
  const MutexLock lock(mutex_);
  const auto process = processes_.find(port.component);
  return process == processes_.end() ? nowhere : process->second;
}

Status OuterEdges::connect(System& system) {
  for (const graph::Edge& edge : edges_) {
    const graph::PortRef& here = ends_of(edge).here;
    Endpoint* const port = system.endpoint(here);
    if (port == nullptr)
      return fail(Code::internal,
                  "port " + here.text() + " was there when the graph was checked, and is not there now");
    const bool is_client = here == edge.client();
    if (is_client) prepare_choice(edge, *port);
    if (const auto memory = memory_.find(edge.name()); memory != memory_.end()) {
      Result<RingSegment> segment = RingSegment::map(memory->second.number());
      if (!segment) return segment.error();
      connect_memory(edge, std::move(segment).value(), *port);
    } else if (Status connected = connect_dds(edge, *port); !connected.ok()) {
      return connected;
    }
    if (is_client) take_first_choice(edge, *port);
  }
  memory_.clear();
  edges_.clear();
  return ok();
}

void OuterEdges::connect_memory(const graph::Edge& edge, RingSegment segment, Endpoint& port) {
  const auto [here, there] = ends_of(edge);
  const auto server = servers_.find(edge.name());
  const auto damaged = [this, name = edge.name(), component = here.component](const Error& reason) {
    damaged_.note(name, component, reason);
  };
  ShmEnd* const end = join(port, {std::move(segment),
                                  {there.text(), doorbell_(there.component), damaged},
                                  policy_of(edge),
                                  server == servers_.end() ? Duration{0} : server->second.period});
  const MutexLock lock(mutex_);
  ends_[edge.name()] = end;
}

Status OuterEdges::check_known(const graph::Edge& edge) {
  for (const graph::PortRef* const end : {&edge.from, &edge.to})
    if (process_of(*end).empty())
      return fail(Code::failed_precondition, "process " + process_ + " does not know component " +
                                                 in_quotes(end->component) + "; orcactl restart " + process_ +
                                                 " lets it begin with the present graph");
  return ok();
}

void OuterEdges::make(const graph::Edge& edge, RingSegment segment, Endpoint& port) {
  remove(edge, port);
  connect_memory(edge, std::move(segment), port);
}

void OuterEdges::remove(const graph::Edge& edge, Endpoint& port) {
  {
    const MutexLock lock(mutex_);
    ends_.erase(edge.name());
  }
  Links::leave(port, ends_of(edge).there.text());
}

Status OuterEdges::connect_dds(const graph::Edge& edge, Endpoint& port) {
  const graph::PortRef& there = ends_of(edge).there;
  if (dds_ == nullptr) {
    const Result<DdsOptions> options = dds_options();
    if (!options) return options.error();
    Result<std::unique_ptr<DdsBackend>> opened = open_dds(*options);
    if (!opened) return opened.error();
    dds_ = std::move(opened).value();
  }
  reached_[edge.name()] = process_of(there);
  const PortContract& server = servers_[edge.name()];
  return dds_->connect(port,
                       {there.text(), process_of(there), server.type.name, 0, clock_of(process_of(there))},
                       policy_of(edge), server.period);
}

// Returns how to ask by how much the clock of a process is ahead; nothing if it has the clock of this one.
std::function<Duration()> OuterEdges::clock_of(const std::string& process) const {
  const auto machine_of = [this](const std::string& name) {
    const auto node = std::ranges::find(whole_.processes, name, &graph::ProcessNode::name);
    return node == whole_.processes.end() ? "" : node->machine;
  };
  const std::string machine = machine_of(process);
  const auto node = std::ranges::find(whole_.machines, machine, &graph::MachineNode::name);
  if (!clock_ahead_ || machine == machine_of(process_) || node == whole_.machines.end()) return {};
  return [this, index = static_cast<std::size_t>(node - whole_.machines.begin())] {
    return clock_ahead_(index);
  };
}

// With several machines all processes use the network between them, as those of one machine must meet, too.
Result<DdsOptions> OuterEdges::dds_options() const {
  DdsOptions options;
  options.graph = whole_.name;
  options.run = run_;
  options.domain = whole_.domain;
  options.process = process_;
  const auto here = std::ranges::find(whole_.processes, process_, &graph::ProcessNode::name);
  const std::string machine = here == whole_.processes.end() ? "" : here->machine;
  if (whole_.secured) {
    Result<std::string> keys = key_folder(whole_.name, machine);
    if (!keys) return keys.error();
    options.keys = std::move(keys).value();
  }
  if (whole_.machines.size() < 2) {
    const Result<std::string> loopback = own_address("", options.address, Duration{0});
    if (loopback) return options;
    return fail(Code::unavailable, "DDS between processes of one machine needs its loopback interface: " +
                                       loopback.error().message +
                                       "; switch it on (ip link set lo up), or leave out link=\"dds\"");
  }
  for (const graph::MachineNode& node : whole_.machines) {
    const bool is_here = node.name == machine;
    if (!is_here && node.address.empty()) continue;
    Result<std::string> address =
        is_here ? own_address(node.interface, node.address, kNetworkPatience) : address_of_host(node.address);
    if (!address) return address.error();
    if (is_here)
      options.address = std::move(address).value();
    else
      options.others.push_back(std::move(address).value());
  }
  return options;
}

void OuterEdges::cut(const std::string& edge, const Error& reason) {
  const MutexLock lock(mutex_);
  if (const auto end = ends_.find(edge); end != ends_.end()) return end->second->cut(reason);
  if (const auto process = reached_.find(edge); process != reached_.end()) dds_->cut(process->second, reason);
}

Status OuterEdges::renew(const std::string& edge, const Descriptor& memory) {
  Result<RingSegment> segment = RingSegment::map(memory.number());
  if (!segment) return segment.error();
  {
    const MutexLock lock(mutex_);
    const auto end = ends_.find(edge);
    if (end == ends_.end()) return fail(Code::not_found, "an edge that this process does not have");
    end->second->renew(std::move(segment).value());
  }
  damaged_.note_renewal(edge);
  return ok();
}

}  // namespace orca::host
