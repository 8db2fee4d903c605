// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "orca/base/descriptor.hpp"
#include "orca/base/doorbell.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/patterns/shm/shm_edges.hpp"
#include "run/system.hpp"

namespace orca::host {

/// The edges between components of this process and those of others, by their index in the graph.
///
/// Thread contract: prepare() and connect() before the components run; the rest from any thread afterwards.
class OuterEdges {
 public:
  /// Returns the word that wakes a component of the graph.
  using Doorbell = std::function<DoorbellWord*(const std::string& component)>;

  /// @param whole  the graph of all processes; outlives the object.
  OuterEdges(const graph::Graph& whole, Doorbell doorbell) : whole_(whole), doorbell_(std::move(doorbell)) {}

  /// Asks the plugins what this process must know of the components at the other ends.
  /// @param memory  of each edge between this process and others.
  /// @errors  those of the catalogue.
  Status prepare(std::map<std::size_t, Descriptor> memory, PluginCatalogue& catalogue);

  /// Makes this process's ends of the edges. Their components get their doorbells.
  /// @errors  internal if a port is missing; those of RingSegment::map().
  Status connect(System& system);

  /// Cuts an edge, because the process at its other end is gone.
  void cut(std::size_t edge, const Error& reason);
  /// Gives an edge new memory, because the process at its other end has been started again.
  /// @errors  not_found; those of RingSegment::map().
  Status renew(std::size_t edge, const Descriptor& memory);

 private:
  Status connect(std::size_t edge, const Descriptor& memory, System& system);
  [[nodiscard]] Result<Duration> period_of(const graph::PortRef& server, PluginCatalogue& catalogue) const;

  const graph::Graph& whole_;
  const Doorbell doorbell_;
  std::map<std::size_t, Descriptor> memory_;      // until connect()
  std::map<std::size_t, Duration> base_periods_;  // of the servers of Push at the other ends
  std::map<std::size_t, ShmEnd*> ends_;
};

}  // namespace orca::host
