// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace orca::plugin {

/// Whether a thread of this process, other than the calling one, may be running code between two addresses:
/// its program counter or something on its stack lies there. A thread that never sleeps while this looks at
/// it counts as one that may. False where the system does not tell.
///
/// A stack is read as it is, without knowing its frames, so a stale word can look like a return address: a
/// "yes" may be wrong, a "no" only if a thread starts such code meanwhile.
[[nodiscard]] bool threads_may_run_in(std::uintptr_t start, std::uintptr_t end);

}  // namespace orca::plugin
