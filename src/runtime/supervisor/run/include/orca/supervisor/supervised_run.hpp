// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/graph/graph.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/stop_signal.hpp"
#include "orca/supervisor/supervised_options.hpp"

namespace orca::supervisor {

/// Runs a checked graph in host processes: starts them, brings everything up, watches, starts again what has died,
/// stops the robot and takes everything down. This process runs no plugin code. If the graph has several machines, it waits
/// for the others first, then begins and ends together with them.
///
/// @param stop      a request ends the run.
/// @param listener  is called during the run, on the calling thread.
/// @thread  the main thread.
[[nodiscard]] host::RunResult run_supervised(const graph::Graph& graph, const SupervisedOptions& options,
                                             host::StopSignal& stop, host::RunListener& listener);

}  // namespace orca::supervisor
