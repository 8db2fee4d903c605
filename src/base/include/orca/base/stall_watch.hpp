// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca {

/// Takes the calling task out of what Executive::stuck_task() watches, until it ends: whoever has started it has a limit of its
/// own for it. Does nothing on a fiber or a baton, which holds up all others.
/// @thread  the task's own.
void leave_stall_watch();

}  // namespace orca
