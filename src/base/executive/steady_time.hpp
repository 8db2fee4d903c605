// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>

#include "orca/base/time.hpp"

namespace orca::detail {

/// Returns the time of the steady clock, shifted once so that it reads as ns since the Unix epoch.
TimePoint steady_now();

/// Converts a TimePoint of steady_now() to the instant of std::chrono.
std::chrono::steady_clock::time_point to_steady(TimePoint time);

}  // namespace orca::detail
