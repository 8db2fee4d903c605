// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::plugin {

/// Ends this process from now on before a system call that would leave a trace outside it. For copies of a process
/// only: it cannot be undone.
///
/// @param last_act  called with the call's number just before the process ends, in a signal handler.
/// @return false if the system cannot do that.
/// @thread  the only one of the process.
[[nodiscard]] bool forbid_effects(void (*last_act)(int system_call));

}  // namespace orca::plugin
