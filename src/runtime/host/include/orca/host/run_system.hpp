// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "orca/base/executive.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/picture.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/stop_signal.hpp"

namespace orca::host {

/// How to run a system.
struct RunOptions {
  ExecutiveOptions executive;
  std::optional<std::uint64_t> seed;  ///< None: the graph's, else 1.
  std::optional<Duration> until;      ///< End then [s of the run's clock]; none: no such limit.
  std::string trace_file;             ///< Empty: none.
  PictureOptions picture;
  std::string log_name = "orca";  ///< The name in the log for what concerns the run as a whole.
};

/// Runs a checked graph in this process: brings everything up or takes everything down again, watches, stops
/// the robot, takes down. Writes to the log, and to the files that the options name.
///
/// @param stop      a request ends the run.
/// @param listener  hears what happens meanwhile.
/// @thread  the main thread.
[[nodiscard]] RunResult run_system(const graph::Graph& graph, PluginCatalogue& catalogue,
                                   const RunOptions& options, StopSignal& stop, RunListener& listener);

}  // namespace orca::host
