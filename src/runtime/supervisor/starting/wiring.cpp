// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wiring.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/graph/placement.hpp"

namespace orca::supervisor {
namespace {

Descriptor copy_of(int descriptor) {
  Descriptor copy(fcntl(descriptor, F_DUPFD_CLOEXEC, 3));
  if (!copy) throw_if_exhausted(errno);
  return copy;
}

}  // namespace

void Wiring::go_over(const graph::Graph& graph) {
  outer_.clear();
  for (const graph::Edge& edge : graph.edges) {
    const std::string& from = graph.find_component(edge.from.component)->process;
    const std::string& to = graph.find_component(edge.to.component)->process;
    if (from == to) continue;
    outer_.push_back({.name = edge.name(),
                      .from = from,
                      .to = to,
                      .needs_memory = edge.link != graph::Link::dds,
                      .is_kept = graph::starts_on_demand(graph, from) || graph::starts_on_demand(graph, to),
                      .server = edge.pattern == Pattern::push ? from : to});
  }
}

Result<Wiring::Lots> Wiring::deal(const std::set<std::string>& processes,
                                  const std::set<std::string>& waking) {
  Lots lots;
  lots.fresh = processes;
  std::erase_if(pools_, [&](const auto& pool) {
    return processes.contains(pool.first) && !waking.contains(pool.first);
  });
  for (const Outer& outer : outer_) {
    if (!outer.needs_memory || !(processes.contains(outer.from) || processes.contains(outer.to))) continue;
    if (takes_over(outer, processes, waking)) {
      for (const std::string& process : {outer.from, outer.to})
        if (waking.contains(process)) hand_out(outer, process, kept_.at(outer.name).file, lots);
    } else if (const Status dealt = deal(outer, lots); !dealt.ok()) {
      return dealt.error();
    }
  }
  for (const auto& [process, file] : pools_)
    if (processes.contains(process)) lots.pools.emplace(process, copy_of(file.descriptor()));
  return lots;
}

Result<Wiring::Lots> Wiring::deal_edges(const std::set<std::string>& edges) {
  Lots lots;
  for (const Outer& outer : outer_) {
    if (!outer.needs_memory || !edges.contains(outer.name)) continue;
    if (const Status dealt = deal(outer, lots); !dealt.ok()) return dealt.error();
  }
  return lots;
}

// Gives both ends of an edge new memory.
Status Wiring::deal(const Outer& outer, Lots& lots) {
  Result<MemoryFile> file = RingSegment::create(outer.name);
  if (!file) return file.error();
  for (const std::string& process : {outer.from, outer.to}) hand_out(outer, process, *file, lots);
  return keep(outer, std::move(file).value());
}

void Wiring::hand_out(const Outer& outer, const std::string& process, const MemoryFile& file, Lots& lots) {
  const std::string& peer = process == outer.from ? outer.to : outer.from;
  std::vector<EdgeMemory>& lot = lots.by_process[process];
  const bool knows = std::ranges::find(lot, peer, &EdgeMemory::peer) != lot.end();
  lot.push_back({outer.name, copy_of(file.descriptor()), peer, knows ? Descriptor{} : pool_of(peer),
                 lots.fresh.contains(peer)});
}

// Returns the pool of a process, which has one as long as it runs. Without one, objects are copied.
Descriptor Wiring::pool_of(const std::string& process) {
  const auto known = pools_.find(process);
  if (known != pools_.end()) return copy_of(known->second.descriptor());
  Result<MemoryFile> file = create_bulk_pool(process);
  if (!file) return {};
  return copy_of(pools_.emplace(process, std::move(file).value()).first->second.descriptor());
}

// Keeps the memory of an edge at a process on demand.
Status Wiring::keep(const Outer& outer, MemoryFile file) {
  if (!outer.is_kept) return ok();
  Result<RingSegment> rings = RingSegment::map(file.descriptor());
  if (!rings) return rings.error();
  kept_.insert_or_assign(outer.name, Kept{std::move(file), std::move(rings).value()});
  return ok();
}

// Returns whether the edge has memory that its new ends can take over: none of them is fresh.
bool Wiring::takes_over(const Outer& outer, const std::set<std::string>& processes,
                        const std::set<std::string>& waking) const {
  const auto is_fresh = [&](const std::string& process) {
    return processes.contains(process) && !waking.contains(process);
  };
  return kept_.contains(outer.name) && !is_fresh(outer.from) && !is_fresh(outer.to);
}

std::uint64_t Wiring::traffic_to(const std::string& process) const {
  std::uint64_t sum = 0;
  for (const Outer& outer : outer_)
    if (const auto kept = kept_.find(outer.name); kept != kept_.end() && outer.server == process)
      sum += kept->second.rings.written_by_client();
  return sum;
}

std::vector<Wiring::Outer> Wiring::edges_at(const std::string& process) const {
  std::vector<Outer> edges;
  std::ranges::copy_if(outer_, std::back_inserter(edges),
                       [&](const Outer& outer) { return outer.from == process || outer.to == process; });
  return edges;
}

}  // namespace orca::supervisor
