// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// What the states of the components mean for a run as a whole.
///
/// Thread contract: pure functions; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/component_report.hpp"

namespace orca::host {

/// The text for people about a component that makes the run a failure.
inline constexpr const char* kMayFailHint =
    "ended in WORK_FAILED, so the run has failed; if it may, say so in the graph with may_fail=\"true\"";

/// Returns how the run ended if the components that the graph names in `ends` have come to an end: all are done, or
/// one that may not fail has failed, which is the error. Returns nothing while the run goes on.
[[nodiscard]] std::optional<Status> ending(const graph::Graph& graph, const Reports& reports);

/// Returns the components for which the end of the run still waits, for people: "command (WORK)".
[[nodiscard]] std::vector<std::string> unfinished(const graph::Graph& graph, const Reports& reports);

/// Returns the components whose last work ended in WORK_FAILED although the graph does not allow it.
[[nodiscard]] std::vector<std::string> failed_components(const graph::Graph& graph, const Reports& reports);

/// Returns the error of a run in which these components have failed.
/// @pre  there is at least one.
[[nodiscard]] Error failure_of(const std::vector<std::string>& failed, const Reports& reports);

}  // namespace orca::host
