// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/host/run_result.hpp"
#include "orca/host/swap.hpp"
#include "orca/supervisor/record.hpp"

namespace orca::supervisor {

/// Returns the counters of connections for people and programs: a line for each Push edge, for each port that sends or
/// asks, for each one that is sent to or asked, and for each component whose laps are measured.
[[nodiscard]] std::vector<Record> to_records(const host::RunCounters& counters);

/// Returns what has become of a swap.
[[nodiscard]] Record to_record(const host::SwapReport& swap);

}  // namespace orca::supervisor
