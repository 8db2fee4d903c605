// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

namespace orca::detail {

/// Returns whether a thread of this process sleeps in a system call. A write that waits for its reader does
/// not count. False where the system does not tell.
[[nodiscard]] bool sleeps_in_system(pid_t thread);

}  // namespace orca::detail
