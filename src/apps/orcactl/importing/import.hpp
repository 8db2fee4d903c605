// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Carries out import: prints a component's file of the thesis as a graph, and on stderr what has no equivalent.
[[nodiscard]] ExitCode import_file(const apps::Call& call);

}  // namespace orca::orcactl
