// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Shows, checks, repairs, compares or converts a recording. Needs no system that runs.
[[nodiscard]] ExitCode handle_bag(const apps::Call& call);

}  // namespace orca::orcactl
