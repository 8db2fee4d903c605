// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "members/member.hpp"
#include "orca/base/result.hpp"
#include "orca/base/shared_memory.hpp"
#include "orca/graph/graph.hpp"
#include "orca/patterns/shm/ring_segment.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// The edges between the processes of a graph, and the memory that each of them uses.
///
/// A process that is started on demand has memory for its edges also while it does not run: its clients write into it, and
/// find the process there later. So they notice nothing but the delay, and what they write tells that it is needed.
///
/// Thread contract: the supervisor's thread.
class Wiring {
 public:
  explicit Wiring(const graph::Graph& graph) { go_over(graph); }
  /// Takes over the edges of another graph. The processes have them already.
  void go_over(const graph::Graph& graph);

  /// An edge between two processes.
  struct Outer {
    std::string name;  ///< Of the edge.
    std::string from;  ///< Process of its `from` end.
    std::string to;
    bool needs_memory;        ///< Its objects go through shared memory.
    bool is_kept = false;     ///< One of the processes is started on demand.
    std::string server = {};  ///< The one of the two processes that the other one uses.
  };

  /// The new memory of the edges at some processes.
  struct Lots {
    std::map<std::string, std::vector<EdgeMemory>> by_process;
    std::map<std::string, Descriptor> pools;  ///< For the bulk data of those processes that are started.
    std::set<std::string> fresh = {};         ///< Those processes.
  };
  /// Makes new memory for all edges that need it and have an end in one of the processes, and new pools for those processes.
  /// @param waking  those of them that take over the memory which waits for them, where there is some.
  /// @errors  unavailable if the system gives none.
  [[nodiscard]] Result<Lots> deal(const std::set<std::string>& processes,
                                  const std::set<std::string>& waking = {});

  /// Makes new memory for edges, by name; not for those that need none.
  /// @errors  as deal().
  [[nodiscard]] Result<Lots> deal_edges(const std::set<std::string>& edges);

  /// Returns how much the clients of a process on demand have written since its edges got new memory [bytes]; 0: nobody
  /// has used it.
  [[nodiscard]] std::uint64_t traffic_to(const std::string& process) const;

  /// Returns the edges between this process and others.
  [[nodiscard]] std::vector<Outer> edges_at(const std::string& process) const;

 private:
  // The memory of an edge at a process on demand.
  struct Kept {
    MemoryFile file;
    RingSegment rings;
  };

  [[nodiscard]] bool takes_over(const Outer& outer, const std::set<std::string>& processes,
                                const std::set<std::string>& waking) const;
  Status deal(const Outer& outer, Lots& lots);
  void hand_out(const Outer& outer, const std::string& process, const MemoryFile& file, Lots& lots);
  [[nodiscard]] Descriptor pool_of(const std::string& process);
  Status keep(const Outer& outer, MemoryFile file);

  std::vector<Outer> outer_;
  std::map<std::string, Kept> kept_;         // by edge
  std::map<std::string, MemoryFile> pools_;  // by process
};

}  // namespace orca::supervisor
