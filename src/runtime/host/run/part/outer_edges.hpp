// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "damaged_edges.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/doorbell.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/patterns/dds/dds_backend.hpp"
#include "orca/patterns/shm/shm_edges.hpp"
#include "run/system/system.hpp"

namespace orca::host {

/// The edges between components of this process and those of others, by graph::Edge::name().
///
/// Thread contract: prepare() and connect() before the components run; make() and remove() on the strand of the port; the rest
/// from any thread afterwards.
class OuterEdges {
 public:
  /// Returns the word that wakes a component of the graph.
  using Doorbell = std::function<DoorbellWord*(const std::string& component)>;

  /// Returns by how much the clock of a machine of the graph is ahead, as in PartOptions.
  using ClockAhead = std::function<Duration(std::size_t machine)>;

  /// @param whole    the graph of all processes; outlives the object.
  /// @param process  the one that this process is.
  /// @param run      the name of the run.
  /// @param reporter  of the part, once it runs: of alarms. It outlives the object, and so does the listener.
  OuterEdges(const graph::Graph& whole, std::string process, Doorbell doorbell, std::string run,
             ClockAhead clock_ahead, std::function<Reporter&()> reporter, PartListener& listener);

  /// Asks the plugins what this process must know of the components at the other ends.
  /// @param memory  of each edge through shared memory.
  /// @errors  those of the catalogue; data_loss if there is memory for what needs none.
  Status prepare(std::map<std::string, Descriptor> memory, PluginCatalogue& catalogue);

  /// Makes this process's ends of the edges. Takes part in DDS if one of them needs it.
  /// @errors  internal if a port is missing; those of RingSegment::map() and of open_dds().
  Status connect(System& system);

  /// Learns of a component that was added to the graph.
  void learn(const graph::ComponentNode& component);

  /// Cuts an edge, because the process at its other end is gone.
  void cut(const std::string& edge, const Error& reason);
  /// Gives an edge new memory, because the process at its other end has been started again. An edge through DDS finds its
  /// new peer by itself.
  /// @errors  not_found; those of RingSegment::map().
  Status renew(const std::string& edge, const Descriptor& memory);

  /// Checks that this process knows the components at both ends of an edge.
  /// @errors  failed_precondition.
  Status check_known(const graph::Edge& edge);
  /// Makes this process's end of an edge through shared memory, in place of the one that is there.
  void make(const graph::Edge& edge, RingSegment segment, Endpoint& port);
  /// Removes this process's end of such an edge. Nothing if there is none.
  void remove(const graph::Edge& edge, Endpoint& port);
  /// Returns the end of an edge that is in this process.
  [[nodiscard]] const graph::PortRef& end_here(const graph::Edge& edge) { return ends_of(edge).here; }

 private:
  // The two ends of an edge, as this process sees them.
  struct Ends {
    const graph::PortRef& here;
    const graph::PortRef& there;
  };

  [[nodiscard]] Ends ends_of(const graph::Edge& edge);
  [[nodiscard]] const std::string& process_of(const graph::PortRef& port);
  void connect_memory(const graph::Edge& edge, RingSegment segment, Endpoint& port);
  Status connect_dds(const graph::Edge& edge, Endpoint& port);
  [[nodiscard]] Result<DdsOptions> dds_options() const;
  [[nodiscard]] std::function<Duration()> clock_of(const std::string& process) const;
  Status learn(const graph::Edge& edge, PluginCatalogue& catalogue);

  const graph::Graph& whole_;
  const std::string process_;
  const Doorbell doorbell_;
  const std::string run_;
  const ClockAhead clock_ahead_;
  std::vector<graph::Edge> edges_;               // to other processes, until connect()
  std::map<std::string, Descriptor> memory_;     // until connect()
  std::map<std::string, PortContract> servers_;  // of Push
  std::unique_ptr<DdsBackend> dds_;              // null: not needed
  std::map<std::string, std::string> reached_;   // over DDS: the process at the other end

  DamagedEdges damaged_;

  Mutex mutex_;
  std::map<std::string, ShmEnd*> ends_ ORCA_GUARDED_BY(mutex_);
  std::map<std::string, std::string> processes_
      ORCA_GUARDED_BY(mutex_);  // by component; also of those that have gone
};

}  // namespace orca::host
