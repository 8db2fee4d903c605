// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Carries out map: asks a part of a running system for its map, and writes that as files; or proposes rooms and doors of such a file.
[[nodiscard]] ExitCode handle_map(const apps::Call& call);

}  // namespace orca::orcactl
