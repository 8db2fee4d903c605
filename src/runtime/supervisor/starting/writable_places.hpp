// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/graph/graph.hpp"
#include "orca/host/run_outputs.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// Returns the folders in which a process may write by its graph: those of all files that parameters of its components and its hardware
/// name (ParamOptions::file), whether the files exist or not; and those of the run's outputs.
/// @param facts    of the graph.
/// @thread  any.
[[nodiscard]] std::vector<std::string> writable_places(const graph::Graph& graph, const std::string& process,
                                                       const SystemFacts& facts,
                                                       const host::RunOutputs& outputs);

}  // namespace orca::supervisor
