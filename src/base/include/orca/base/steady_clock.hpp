// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// The clock of steady runs: the system's steady clock, shifted so that it reads as ns since the Unix epoch.
///
/// Thread contract: any thread, but set_steady_epoch().
#pragma once

#include <chrono>

#include "orca/base/time.hpp"

namespace orca {

/// Returns the time of the steady clock.
[[nodiscard]] TimePoint steady_now();

/// Converts a time of steady_now() to the instant of std::chrono.
[[nodiscard]] std::chrono::steady_clock::time_point to_steady(TimePoint time);

/// Returns what steady_now() adds to the system's steady clock [s]: by default what made both of the system's clocks
/// agree when it was asked for the first time.
[[nodiscard]] Duration steady_epoch();

/// Sets what steady_now() adds, so that all processes of a system have one clock, whatever the system's other clock
/// does meanwhile.
/// @thread  before any other thread reads the clock.
void set_steady_epoch(Duration epoch);

}  // namespace orca
