// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "orca/host/run_result.hpp"

namespace orca::deployer {

/// Returns the text that ends a run whose progress was shown: time, arrivals, contacts, ways and mean speeds. What
/// the connections dropped and delivered late is the last line of stats_text().
/// @param wall  time that the run took on the wall clock [s].
[[nodiscard]] std::string summary_text(const host::RunResult& result, Duration wall);

}  // namespace orca::deployer
