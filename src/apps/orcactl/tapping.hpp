// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "call.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Carries out echo, hz or latency: looks at the objects that pass a port.
[[nodiscard]] ExitCode tap(const Call& call);

}  // namespace orca::orcactl
