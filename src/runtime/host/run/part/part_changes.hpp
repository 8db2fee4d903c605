// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/hosted_part.hpp"
#include "outer_edges.hpp"
#include "outer_offers.hpp"
#include "run/swap/rewiring.hpp"
#include "run/swap/swaps.hpp"
#include "run/system/watched_system.hpp"

namespace orca::host {

/// What changes in the part of a system while it runs: components come and go, in this process or in others, and connections.
///
/// Thread contract: the part's main task.
class PartChanges {
 public:
  /// The graph of all processes, as it is now.
  struct Whole {
    graph::Graph& graph;
    std::mutex& mutex;  ///< Held while it changes, and by other threads that read it or use ports.
  };

  /// @param process  the one that this process is. All others outlive the object.
  PartChanges(std::string process, Whole whole, PluginCatalogue& catalogue, WatchedSystem& watched,
              OuterEdges& outer, OuterOffers& offers, Swaps& swaps);

  /// Learns of a component, and constructs it if it is this process's.
  /// @param params  all of them, as written in a graph.
  /// @errors  those of System::add(); invalid_argument for the parameters.
  Status add(graph::ComponentNode node, const std::map<std::string, std::string>& params);
  /// Lets a component work.
  /// @errors  not_found.
  Status open_gate(const std::string& name);
  /// Forgets a component, after it has ended if it was this process's.
  /// @param last  takes it before it is destroyed.
  /// @errors  those of System::remove(); failed_precondition while its code is being exchanged, or it is connected.
  Status remove(const std::string& name, TimePoint limit,
                const std::function<void(const ComponentInstance&)>& last);
  /// Makes and removes connections; see PartOrder::connections.
  /// @errors  those of System::on_strand(), of rewiring_of() and of RingSegment::map(); invalid_argument if the changes are
  ///          those of several components. Nothing has changed then, and nothing will.
  Status rewire(const std::vector<ConnectionChange>& changes, TimePoint limit);

 private:
  Result<graph::Params> read_params(const graph::ComponentNode& node,
                                    const std::map<std::string, std::string>& texts);
  [[nodiscard]] Result<Rewiring> prepare(const ConnectionChange& change);
  void forget(const std::string& component);
  [[nodiscard]] Status check_unconnected(const std::string& component) const;

  const std::string process_;
  const Whole whole_;
  PluginCatalogue& catalogue_;
  WatchedSystem& watched_;
  OuterEdges& outer_;
  OuterOffers& offers_;
  Swaps& swaps_;
};

}  // namespace orca::host
