// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "member.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// Takes a report that is no answer.
/// @errors  data_loss if it cannot be: the process is then ended.
using TakeReport = std::function<Status(const Report& report)>;

/// Writes what a process has printed since the last time to the log.
/// @return whether it was something.
/// @pre  the member has a process.
/// @thread  the supervisor's thread.
bool read_output(Member& member, Moment now);

/// Takes what a process has said and printed since the last time, and writes what it has printed to the log. Answers go to
/// the member, and so do last words.
/// @return whether it had printed something.
/// @pre  the member has a process.
/// @thread  the supervisor's thread.
bool listen(Member& member, const TakeReport& take, Moment now);

}  // namespace orca::supervisor
