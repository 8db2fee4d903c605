// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::plugin {

/// Runs `attempt` in a copy of this process, so that a crash, exit() or endless loop in it ends the copy
/// alone. What it does to memory is lost; what it reports by throwing is not a failure of the trial.
///
/// @param attempt  calls its argument before each step with what comes now, for people.
/// @errors  internal with the step and how it ended the copy; deadline_exceeded if it did not come to an end
/// in time.
/// @thread  any; of the other threads the copy has none.
[[nodiscard]] Status survives_trial(
    const std::function<void(const std::function<void(const std::string&)>&)>& attempt, Duration limit);

}  // namespace orca::plugin
