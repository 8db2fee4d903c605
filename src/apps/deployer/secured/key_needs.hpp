// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"

namespace orca::deployer {

/// Returns which keys a secured graph needs where, a line for each machine; empty: it is not secured.
[[nodiscard]] std::string key_needs(const graph::Graph& graph);

/// Checks that the processes of a secured graph have keys on this machine. Whether the keys are good is for the processes to say: they
/// read them.
/// @param machine  of the graph; empty: it declares none.
/// @errors  not_found with what to do.
[[nodiscard]] Status check_keys(const graph::Graph& graph, const std::string& machine);

}  // namespace orca::deployer
