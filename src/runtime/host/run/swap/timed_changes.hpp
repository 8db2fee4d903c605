// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/host/timed_change.hpp"
#include "run/swap/swaps.hpp"
#include "run/system/system.hpp"
#include "run/system/watched_system.hpp"

namespace orca::host {

/// Carries out changes of a system at their times: code is exchanged and parameters are set between two laps each. In virtual
/// time the same changes give the same run.
///
/// Thread contract: one task, the executive's main task.
class TimedChanges {
 public:
  /// All of these outlive the object.
  /// @param graph    as Swaps; gets the components and connections that come and go.
  /// @param changes  sorted by time.
  TimedChanges(graph::Graph& graph, WatchedSystem& watched, PluginCatalogue& catalogue, Executive& executive,
               const std::vector<TimedChange>& changes);

  /// Begins to count: everything is up now.
  void begin() { began_ = executive_.now(); }
  /// Begins what is due, and goes on with what is under way. To be called whenever a component has changed, and at the time that
  /// it returns.
  /// @errors  those of Swaps and of System, with the change; the run has failed then.
  Result<TimePoint> go_on();
  /// Looks once more at what is under way, when the run ends, and warns of the changes whose time did not come.
  /// @errors  as go_on().
  Status finish();
  /// Ends everything as it is. @pre  the system has been taken down.
  void give_up() { swaps_.give_up(); }
  /// Returns the swaps, to which others may add; go_on() goes on with them, too.
  [[nodiscard]] Swaps& swaps() { return swaps_; }

 private:
  Status carry_out(const TimedChange& change);
  void exchange(const TimedChange& change, const graph::GraphPlan::Exchange& exchange);
  void note(const TimedChange& change, const Error& error);

  Status set(const std::map<std::string, graph::Params>& settings);
  Status add(const graph::GraphPlan& plan);
  Status remove(const std::vector<std::string>& components);
  Status rewire(const std::vector<graph::GraphPlan::Rewiring>& connections);
  Status rewire(const graph::Edge& edge, bool makes);

  graph::Graph& graph_;
  WatchedSystem& watched_;
  PluginCatalogue& catalogue_;
  Executive& executive_;
  const std::vector<TimedChange>& changes_;
  Swaps swaps_;
  TimePoint began_{};
  std::size_t next_ = 0;
  std::optional<Error> error_;  // the first
};

}  // namespace orca::host
