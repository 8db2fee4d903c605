// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Returns what the command line of orcactl keys may hold.
[[nodiscard]] apps::Command keys_command();

/// Makes, renews or revokes the keys of a secured system, from its graph: orcactl keys.
[[nodiscard]] ExitCode handle_keys(const apps::Call& call);

}  // namespace orca::orcactl
