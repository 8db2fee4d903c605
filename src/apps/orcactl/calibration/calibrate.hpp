// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "common/command_line.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Prints the figures that correct the odometry of a base, from a recording with its odometry and the scans of a laser.
[[nodiscard]] ExitCode calibrate(const apps::Call& call);

}  // namespace orca::orcactl
