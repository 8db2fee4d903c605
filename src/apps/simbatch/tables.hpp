// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/batch/store.hpp"

namespace orca::simbatch {

/// Takes a line of a table, with its end.
using Take = std::function<void(std::string_view)>;

/// Hands out all runs as CSV, ordered by variant, world and seed. It is the same whenever and wherever they are made.
/// @errors  unavailable, with the reason.
Status runs_table(const batch::Store& store, const Take& take);

/// Hands out what each run took of the machine, as CSV in the same order: wall and processor time [s].
/// @errors  unavailable, with the reason.
Status timing_table(const batch::Store& store, const Take& take);

/// Hands out the processor time of the laps of each run's components [s], as CSV in the same order.
/// @errors  unavailable, with the reason.
Status laps_table(const batch::Store& store, const Take& take);

/// Returns a line for each variant with the mean processor time per lap of each component.
[[nodiscard]] std::string laps_summary(const batch::Store& store);

/// Writes all three, as runs.csv, timing.csv and laps.csv.
/// @errors  unavailable, with the reason.
Status write_tables(const batch::Store& store, const std::filesystem::path& folder);

}  // namespace orca::simbatch
