// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "exit_code.hpp"
#include "options.hpp"

namespace orca::deployer {

/// Does what the command line asks for.
/// @return the exit status of the program.
ExitCode act(const Options& options);

}  // namespace orca::deployer
