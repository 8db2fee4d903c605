// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::plugin {

/// Runs `attempt` in a copy of this process, so that a crash, exit() or endless loop affects only the copy.
/// Its changes to memory are lost. An exception is not a failure of the trial.
///
/// @param attempt  calls its argument before each step with a description of the step, for people.
/// @errors  internal with the step and how it ended the copy; deadline_exceeded if it takes too long.
/// @thread  any; the copy has only the calling thread.
[[nodiscard]] Status survives_trial(
    const std::function<void(const std::function<void(const std::string&)>&)>& attempt, Duration limit);

}  // namespace orca::plugin
