// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Records a running system into an MCAP file or a log of CARMEN, until the system ends, the time is over, or a signal comes.
[[nodiscard]] ExitCode record(const apps::Call& call);

}  // namespace orca::orcactl
