// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::simbatch {

/// Returns how far a batch is, as one JSON value: how many runs of each variant are there, how they ended, and those without success, the
/// first 500, with the commands that make them again. Other processes may add runs meanwhile.
/// @errors  unavailable, with the reason.
[[nodiscard]] Result<std::string> status_json(const batch::Experiment& experiment, const batch::Store& store);

}  // namespace orca::simbatch
