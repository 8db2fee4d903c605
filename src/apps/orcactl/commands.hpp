// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"

namespace orca::orcactl {

/// Returns the table of what the command line of orcactl may hold.
[[nodiscard]] const apps::Program& program();

}  // namespace orca::orcactl
