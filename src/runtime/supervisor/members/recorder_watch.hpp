// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "members/ledger.hpp"

namespace orca::supervisor {

/// What is wrong with programs beside the system that record it, by what they serve.
using Unrecorded = std::map<std::string, std::string>;

/// Raises the alarm RECORDING_LOST of each program that was well before, and settles that of each one that is well again.
/// @thread  the supervisor's.
void note_recorders(const Unrecorded& before, const Unrecorded& now, Ledger& ledger);

}  // namespace orca::supervisor
