// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// Which process of a graph writes which outputs of a run.
///
/// Thread contract: pure functions; any thread.
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/run_outputs.hpp"

namespace orca::supervisor {

/// Checks that each output can be written by one process: a trace needs all parts in one, the ports of one recording are in
/// one, and so is all hardware if a picture is wanted.
/// @errors  invalid_argument with the first that cannot.
[[nodiscard]] Status check_outputs(const graph::Graph& graph, const host::RunOutputs& outputs);

/// Returns what a process of the graph writes of these outputs.
/// @pre  check_outputs() has found nothing.
[[nodiscard]] host::RunOutputs outputs_of(const graph::Graph& graph, const std::string& process,
                                          const host::RunOutputs& outputs);

}  // namespace orca::supervisor
