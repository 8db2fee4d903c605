// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "members/ledger.hpp"
#include "members/reply.hpp"

namespace orca::supervisor {

/// Answers what an operator asks about alarms, and takes out those that are acknowledged.
///
/// @param words  none: all are shown; "ack" and numbers, or "ack" and "all".
/// @thread  the supervisor's.
void handle_alarms(const std::vector<std::string>& words, Ledger& ledger, Reply& reply);

}  // namespace orca::supervisor
