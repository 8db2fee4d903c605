// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/host/peer_call.hpp"
#include "watched_system.hpp"

namespace orca::host {

/// Carries out the orders of components about others in a run whose components are all in this process, one after the other, and lets
/// go on what was suspended for components that have ended. It waits for components to come to the end of a lap.
/// @thread  the executive's main task.
void carry_out_peer_orders(WatchedSystem& watched);

}  // namespace orca::host
