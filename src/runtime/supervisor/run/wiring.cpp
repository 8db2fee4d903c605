// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wiring.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/patterns/shm/ring_segment.hpp"

namespace orca::supervisor {
namespace {

Descriptor copy_of(int descriptor) {
  Descriptor copy(fcntl(descriptor, F_DUPFD_CLOEXEC, 3));
  if (!copy) throw_if_exhausted(errno);
  return copy;
}

}  // namespace

Wiring::Wiring(const graph::Graph& graph) {
  for (std::size_t edge = 0; edge < graph.edges.size(); ++edge) {
    const std::string& from = graph.find_component(graph.edges[edge].from.component)->process;
    const std::string& to = graph.find_component(graph.edges[edge].to.component)->process;
    const std::string name = graph.edges[edge].from.text() + " to " + graph.edges[edge].to.text();
    if (from != to) outer_.push_back({edge, name, from, to, graph.edges[edge].link != graph::Link::dds});
  }
}

Result<Wiring::Lots> Wiring::deal(const std::set<std::string>& processes) const {
  Lots lots;
  for (const Outer& outer : outer_) {
    if (!outer.needs_memory || !(processes.contains(outer.from) || processes.contains(outer.to))) continue;
    const Result<MemoryFile> memory = RingSegment::create(outer.name);
    if (!memory) return memory.error();
    for (const std::string& process : {outer.from, outer.to})
      lots.by_process[process].push_back({outer.edge, copy_of(memory->descriptor())});
  }
  return lots;
}

std::vector<Wiring::Outer> Wiring::edges_at(const std::string& process) const {
  std::vector<Outer> edges;
  std::ranges::copy_if(outer_, std::back_inserter(edges),
                       [&](const Outer& outer) { return outer.from == process || outer.to == process; });
  return edges;
}

}  // namespace orca::supervisor
