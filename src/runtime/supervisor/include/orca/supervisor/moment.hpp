// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>

namespace orca::supervisor {

/// An instant of the supervisor's own clock, which never jumps and does not depend on any run.
using Moment = std::chrono::steady_clock::time_point;

}  // namespace orca::supervisor
