// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "member.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// The edges between the processes of a graph, and the memory that each of them uses.
///
/// Thread contract: the supervisor's thread.
class Wiring {
 public:
  explicit Wiring(const graph::Graph& graph);

  /// An edge between two processes.
  struct Outer {
    std::size_t edge;  ///< Index in the graph.
    std::string name;  ///< For people: "a.out to b.in".
    std::string from;  ///< Process of its `from` end.
    std::string to;
    bool needs_memory;  ///< Its objects go through shared memory.
  };

  /// The new memory of the edges at some processes.
  struct Lots {
    std::map<std::string, std::vector<EdgeMemory>> by_process;
  };
  /// Makes new memory for all edges that need it and have an end in one of the processes.
  /// @errors  unavailable if the system gives none.
  [[nodiscard]] Result<Lots> deal(const std::set<std::string>& processes) const;

  /// Returns the edges between this process and others.
  [[nodiscard]] std::vector<Outer> edges_at(const std::string& process) const;

 private:
  std::vector<Outer> outer_;
};

}  // namespace orca::supervisor
