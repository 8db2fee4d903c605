// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/part_access.hpp"
#include "orca/host/planned_failure.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_outputs.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/stop_signal.hpp"
#include "orca/host/timed_change.hpp"

namespace orca::host {

/// The options of a run.
struct RunOptions : RunOutputs {
  ExecutiveOptions executive;
  std::optional<std::uint64_t> seed;             ///< None: 1.
  std::optional<Duration> until;                 ///< Time limit [s of the run's clock]; none: no limit.
  std::vector<PlannedFailure> planned_failures;  ///< What is to fail on purpose, in components of the graph.
  std::vector<TimedChange> changes;              ///< What becomes of the graph meanwhile, sorted by time.
  double computing = 1.0;         ///< In virtual time laps take this many times as long as the graph says.
  bool measures_laps = false;     ///< The result has the processor time of each component's laps.
  bool keeps_motion = false;      ///< The result has a Scene with the true motion of simulated robots.
  std::string log_name = "orca";  ///< Name in the log for what concerns the run as a whole.
  /// Who look at the run and give it orders, from enter() to leave(); null: nobody does.
  /// @pre  in virtual time; `changes` is empty.
  RunVisitors* visitors = nullptr;
};

/// Runs a checked graph in this process: brings everything up, watches it, stops the robot and takes
/// everything down. If something does not come up, the rest is taken down again. Writes to the log, and to
/// the files that the options name.
///
/// @param stop      a request ends the run.
/// @param listener  is called during the run.
/// @thread  the main thread.
[[nodiscard]] RunResult run_system(const graph::Graph& graph, PluginCatalogue& catalogue,
                                   const RunOptions& options, StopSignal& stop, RunListener& listener);

}  // namespace orca::host
