// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string_view>

#include "exit_code.hpp"

namespace orca::deployer {

/// Makes stdin, stdout, stderr and all output files fit for use: a standard stream that is closed becomes one
/// that cannot be used, so that no file takes its number, and output that cannot be written is an error instead
/// of a signal that ends the process.
/// @thread  the main thread, before anything else.
void prepare_streams();

/// Writes a text to stdout at once. The first failure is reported on stderr.
/// @thread  any.
void write_out(std::string_view text);

/// Returns the exit status of the program: `status`, but failed_running if it would be 0 and stdout could not be
/// written.
/// @thread  any.
[[nodiscard]] int exit_status(ExitCode status);

}  // namespace orca::deployer
