// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "orca/host/run_result.hpp"

namespace orca::deployer {

/// Returns the text that `--stats` prints at the end of a run: a table of the Push connections, one of the
/// ports that send or ask, one of the components whose laps take virtual time, and a line that sums up what went wrong on them.
[[nodiscard]] std::string stats_text(const host::RunCounters& counters);

/// Returns the last line of that text: drops, missed deadlines and refusals.
[[nodiscard]] std::string trouble_text(const host::RunCounters& counters);

}  // namespace orca::deployer
