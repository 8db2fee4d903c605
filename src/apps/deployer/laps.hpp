// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "orca/base/output_file.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/run_result.hpp"

namespace orca::deployer {

/// Writes what a run has measured of the laps of its components, as a file that `takes` of a graph can name.
/// @errors  those of the file.
[[nodiscard]] Status write_laps(OutputFile& file, const graph::Graph& graph, const host::RunResult& result);

}  // namespace orca::deployer
