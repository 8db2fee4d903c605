// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "orca/base/result.hpp"

namespace orca::orcactl {

/// The exit status of the program.
enum class ExitCode { done = 0, refused = 1, usage = 2, no_deployer = 3 };

/// An error, and the exit status to which it leads. A plain value.
struct Failure {
  Error error;
  ExitCode code = ExitCode::refused;
};

}  // namespace orca::orcactl
