// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "orca/host/run_result.hpp"

namespace orca::deployer {

/// The exit status of the program.
enum class ExitCode { finished = 0, failed_running = 1, bad_input = 2, could_not_start = 3 };

/// Returns the exit status after a run.
[[nodiscard]] constexpr ExitCode exit_code_of(host::RunOutcome outcome) {
  switch (outcome) {
    case host::RunOutcome::finished:
    case host::RunOutcome::time_is_up:
    case host::RunOutcome::stopped: return ExitCode::finished;
    case host::RunOutcome::failed: return ExitCode::failed_running;
    case host::RunOutcome::not_started: return ExitCode::could_not_start;
    case host::RunOutcome::bad_options: return ExitCode::bad_input;
  }
  return ExitCode::failed_running;
}

}  // namespace orca::deployer
