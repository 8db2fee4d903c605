// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_result.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// Tells why a run does not start.
/// @return its result.
host::RunResult refuse(const Error& error, const std::string& log_name, host::RunListener& listener);

/// Returns the error of a robot that no emergency stop can reach, and that therefore does not begin to move.
[[nodiscard]] Error unreachable(Error why);

/// Checks whether the plugins of the system are still there: a process loads all of them when it is started.
/// @errors  failed_precondition, with the file and what to do.
[[nodiscard]] Status can_start_processes(const SystemFacts& facts);

}  // namespace orca::supervisor
