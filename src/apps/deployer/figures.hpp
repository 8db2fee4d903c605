// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <string>

#include "orca/base/time.hpp"
#include "orca/host/run_result.hpp"

namespace orca::deployer {

/// Returns a number with so many digits behind the point.
[[nodiscard]] std::string fixed(double value, int digits);

/// Returns "no drops", "1 drop", "2 drops".
[[nodiscard]] std::string count_of(std::uint64_t number, const std::string& thing);

/// Returns how long a run has lasted: "12.3 s", or "12.3 s simulated, 41 x real time".
/// @param wall  time that it took on the wall clock [s].
[[nodiscard]] std::string time_text(Duration time, bool simulated, Duration wall);

/// Returns the text that ends a run whose progress was shown: time, arrivals, contacts, ways and mean speeds. What
/// the connections dropped and delivered late is the last line of stats_text().
/// @param wall  time that the run took on the wall clock [s].
[[nodiscard]] std::string summary_text(const host::RunResult& result, Duration wall);

}  // namespace orca::deployer
