// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "orca/base/executive.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/picture.hpp"
#include "orca/host/stop_signal.hpp"

namespace orca::host {

/// How to run a system.
struct RunOptions {
  ExecutiveOptions executive;
  std::optional<std::uint64_t> seed;  ///< None: the graph's, else 1.
  std::optional<Duration> until;      ///< End then [s of the run's clock]; none: no such limit.
  std::string trace_file;             ///< Empty: none.
  PictureOptions picture;
};

/// Exit codes of the deployer (DESIGN 15).
enum class ExitCode { finished = 0, failed_running = 1, bad_input = 2, could_not_start = 3 };

/// Runs a checked graph in this process: brings everything up or takes everything down again, watches, stops
/// the robot, takes down. Prints announcements and, in virtual time, the trace hash on stdout; the rest on
/// stderr.
///
/// @param stop  a request ends the run with `finished`.
/// @thread  the main thread.
ExitCode run_system(const graph::Graph& graph, PluginCatalogue& catalogue, const RunOptions& options,
                    StopSignal& stop);

}  // namespace orca::host
