// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"

namespace orca::supervisor {

/// What a host process does for itself when it begins.

/// Takes over the control channel that HostProcess::start() has given to this process. Children of this process do not
/// inherit it.
/// @errors  failed_precondition if it was not started so.
/// @pre  called once, before any descriptor is opened or closed.
/// @thread  the main thread.
[[nodiscard]] Result<Descriptor> take_channel();

/// Gives this process a name for ps and top. The system cuts it off after 15 bytes.
/// @thread  the main thread.
void set_process_name(const std::string& name);

/// Chooses whether the system kills this process when its supervisor dies. Only for times in which it does not listen to
/// the control channel, and in which no motor can run.
/// @pre  the supervisor's main thread has started this process.
/// @thread  any.
void die_with_supervisor(bool dies);

/// Locks the memory of this process, present and future, as it is touched: no page of it goes to disk.
/// @return a warning for people if the system refuses; then nothing is locked.
/// @thread  any.
[[nodiscard]] std::optional<std::string> lock_memory();

}  // namespace orca::supervisor
