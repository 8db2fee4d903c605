// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Carries out send or query: hands an object to a port, and prints the reply.
[[nodiscard]] ExitCode offer(const apps::Call& call);

}  // namespace orca::orcactl
