// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/doorbell.hpp"
#include "orca/base/executive.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/process.hpp"
#include "orca/supervisor/run_page.hpp"

namespace orca::supervisor {

/// Where the doorbells of a machine's components are in the run page.
///
/// Thread contract: any thread.
class Doorbells {
 public:
  /// @param processes  of the machine.
  /// @param executor   that the command line asks for; nothing: each process has its own.
  /// @param names      of the components, in the order of their words in the page.
  /// @param page       outlives the object.
  Doorbells(const graph::Graph& whole, std::vector<graph::ProcessNode> processes,
            std::optional<Backend> executor, std::vector<std::string> names, const RunPage& page);

  /// Learns of a component that was added to the graph.
  /// @param place  of its word among those of the components.
  void add(const graph::ComponentNode& component, std::size_t place);

  /// Returns the word that wakes a component, in whatever process it is. Fibers have one word together.
  /// @pre  the component is known, and its process is one of the machine.
  [[nodiscard]] DoorbellWord& of(const std::string& component) const;

  /// Returns the components, in the order of their words.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  const std::vector<graph::ProcessNode> nodes_;
  const std::optional<Backend> executor_;
  const RunPage& page_;
  mutable std::mutex mutex_;
  // Below: guarded by mutex_.
  std::vector<std::string> names_;
  std::map<std::string, std::string> processes_;  // by component
};

}  // namespace orca::supervisor
