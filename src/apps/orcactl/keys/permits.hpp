// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <vector>

#include "orca/graph/graph.hpp"
#include "orca/keys/permit.hpp"

namespace orca::orcactl {

/// Returns what each process of a graph that speaks over DDS may write and read: the topics of its own edges, and what it needs to
/// speak with the processes at their other ends. With several machines also that of each process that speaks for a machine.
/// @thread  pure function.
[[nodiscard]] std::vector<keys::Permit> permits_of(const graph::Graph& graph);

}  // namespace orca::orcactl
