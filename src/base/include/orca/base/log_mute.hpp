// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::log {

/// Ends the log of this process: no line is written or heard any more. It is for the copy of a process (fork), where another
/// thread of the original may have held a lock of the log, which nobody will ever release.
///
/// @thread  any; takes no lock.
void mute();

/// Returns whether the log has ended.
///
/// @thread  any; takes no lock.
[[nodiscard]] bool is_muted();

}  // namespace orca::log
