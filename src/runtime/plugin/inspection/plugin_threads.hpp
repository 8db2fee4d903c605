// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace orca::plugin {

/// Returns whether another thread of this process may be running code between two addresses: its program
/// counter or a word on its stack lies there. A thread that does not sleep during the check counts as one
/// that may. False where the system does not report it.
///
/// A stack is read without knowledge of its frames, so a stale word can look like a return address. True may
/// therefore be wrong. False is wrong only if a thread starts such code meanwhile.
[[nodiscard]] bool threads_may_run_in(std::uintptr_t start, std::uintptr_t end);

}  // namespace orca::plugin
