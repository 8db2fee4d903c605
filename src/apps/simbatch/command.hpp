// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::simbatch {

/// Runs a program of the PATH to its end, and returns what it wrote to stdout. Its stderr is that of this process.
/// @errors  not_found: there is no such program; failed_precondition: it ended with another status than 0.
Result<std::string> output_of(const std::vector<std::string>& words);

}  // namespace orca::simbatch
