// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>

#include "members/ledger.hpp"
#include "orca/base/steady_clock.hpp"

namespace orca::supervisor {

/// What is known of programs beside the system that record it.
struct RecorderWatch {
  std::map<std::string, std::string> wrong{};  ///< What is wrong, by what they serve.
  Moment looked{};
};

/// Looks at the programs that record the system, once a second: raises the alarm RECORDING_LOST of each that was well before, and settles
/// that of each that is well again.
/// @param look  as SupervisedOptions::look_beside; empty: there are none.
/// @param has_come_up  whether the system has, for `look`.
/// @thread  the supervisor's.
void look_at_recorders(RecorderWatch& watch,
                       const std::function<std::map<std::string, std::string>(bool)>& look, bool has_come_up,
                       Moment now, Ledger& ledger);

}  // namespace orca::supervisor
