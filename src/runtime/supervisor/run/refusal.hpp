// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_result.hpp"

namespace orca::supervisor {

/// Tells why a run does not start.
/// @return its result.
host::RunResult refuse(const Error& error, const std::string& log_name, host::RunListener& listener);

/// Returns the error of a robot that no emergency stop can reach, and that therefore does not begin to move.
[[nodiscard]] Error unreachable(Error why);

}  // namespace orca::supervisor
