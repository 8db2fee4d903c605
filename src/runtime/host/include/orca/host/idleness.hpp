// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/component_report.hpp"
#include "orca/host/run_result.hpp"

namespace orca::host {

/// A run that is shorter ends before everybody has had something to do [s].
inline constexpr Duration kShortRun{std::chrono::seconds(1)};

/// Something that did not happen in a whole run.
struct Idleness {
  std::string component;  ///< Empty: nothing went over any connection.
  std::string text;       ///< For people, with the reason.
};

/// Returns the components that have done nothing in the whole run, and whether nothing went over any connection. A
/// component that only serves others, or that is loaded on demand, may have had nothing to do.
/// @thread  any.
[[nodiscard]] std::vector<Idleness> find_idleness(const graph::Graph& graph, const Reports& reports,
                                                  const RunCounters& counters);

}  // namespace orca::host
