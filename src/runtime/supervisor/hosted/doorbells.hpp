// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "orca/base/doorbell.hpp"
#include "orca/base/executive.hpp"
#include "orca/base/mutex.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/process.hpp"
#include "orca/supervisor/run_page.hpp"

namespace orca::supervisor {

/// Where the doorbells of a machine's components are in the run page.
///
/// Thread contract: any thread.
class Doorbells {
 public:
  /// Names in the order of their words in the page.
  struct Words {
    std::vector<std::string> components;
    std::vector<std::string> processes;
  };

  /// @param processes  of the machine.
  /// @param executor   that the command line asks for; nothing: each process has its own.
  /// @param page       outlives the object.
  Doorbells(const graph::Graph& whole, const std::vector<graph::ProcessNode>& processes,
            std::optional<Backend> executor, Words words, const RunPage& page);

  /// Learns of a component that was added to the graph, or has another process now.
  /// @param place  of its word among those of the components.
  void add(const graph::ComponentNode& component, std::size_t place);

  /// Learns of a process that begins, or begins anew with another executor.
  /// @param place  of its word among those of the processes.
  void add_process(const std::string& process, std::size_t place, bool is_of_fibers);

  /// Returns the word that wakes a component, in whatever process it is. Fibers have one word together.
  /// @pre  the component is known, and its process is one of the machine.
  [[nodiscard]] DoorbellWord& of(const std::string& component) const;

  /// Returns what has a word.
  [[nodiscard]] Words words() const;

 private:
  const RunPage& page_;
  mutable Mutex mutex_;
  Words words_ ORCA_GUARDED_BY(mutex_);
  std::set<std::string> of_fibers_ ORCA_GUARDED_BY(mutex_);               // processes
  std::map<std::string, std::string> processes_ ORCA_GUARDED_BY(mutex_);  // by component
};

}  // namespace orca::supervisor
