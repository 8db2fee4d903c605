// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <optional>
#include <string>

#include "common/command_line.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Returns what people should know of processes that run without a deployer, to be added to "no system runs"; empty: there
/// are none.
/// @param system  name of its graph; empty: any.
[[nodiscard]] std::string hint_at_orphans(const std::string& system);

/// Gives a command to the processes of a system that run without a deployer: they obey stop and estop.
/// @return nothing if the command is another one, or if there are no such processes.
[[nodiscard]] std::optional<ExitCode> order_orphans(const apps::Call& call);

}  // namespace orca::orcactl
