// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

namespace orca::detail {

/// Whether a thread of this process sleeps in the system, other than to write something that nobody reads
/// yet. False where the system does not tell.
[[nodiscard]] bool sleeps_in_system(pid_t thread);

}  // namespace orca::detail
