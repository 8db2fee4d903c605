// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "options.hpp"

namespace orca::simbatch {

/// Says on stdout what differs between the results of two batches, down to the first delivery.
[[nodiscard]] ExitCode diff(const Options& options);

}  // namespace orca::simbatch
