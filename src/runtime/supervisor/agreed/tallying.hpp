// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// What a run has counted and shows, to and from the reports of its processes.
///
/// Thread contract: pure functions; any thread.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/run_view.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

[[nodiscard]] Tally to_tally(const host::RunCounters& counters,
                             const std::vector<host::RunResult::Way>& ways);

/// Adds what a process has done in a later life to what it had done before.
void add(const Tally& more, Tally& sum);

/// Puts the tallies of all processes together: edges in the order of the graph, ways by the names of the robots. Of a way
/// that several processes tell, the longest counts.
/// @param tallies  from untrusted processes; numbers that are missing count as 0, further ones are ignored.
[[nodiscard]] host::RunCounters counters_of(const graph::Graph& graph,
                                            const std::map<std::string, Tally>& tallies);
[[nodiscard]] std::vector<host::RunResult::Way> ways_of(const std::map<std::string, Tally>& tallies);

[[nodiscard]] Glance to_report(const host::RunGlance& glance);
/// Adds what a process shows to what is known of the run.
void add(const Glance& shown, host::RunGlance& glance);

}  // namespace orca::supervisor
