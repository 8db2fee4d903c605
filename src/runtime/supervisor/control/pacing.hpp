// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "members/conductor.hpp"
#include "members/reply.hpp"
#include "orca/base/system/pace.hpp"

namespace orca::supervisor {

// What an operator orders about the pace of virtual time. Each answers with a record of what is so then: the time of the run,
// its pace, and whether it is paused.
// @param pace  null: the run is in real time, and the order is refused.
// @thread  the supervisor's thread.

/// Shows the pace, or sets it: a number, "fast", or 0 for a pause.
void set_pace(const std::vector<std::string>& words, Pace* pace, Reply& reply);
/// Pauses.
void pause(Pace* pace, Reply& reply);
/// Lets a time pass, and pauses. It waits until that is done, so a job of the conductor calls it.
void step(const std::vector<std::string>& words, Pace* pace, Conductor& conductor, Reply& reply);

}  // namespace orca::supervisor
