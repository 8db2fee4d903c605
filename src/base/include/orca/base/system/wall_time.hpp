// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/time.hpp"

namespace orca::log {

/// Return the absolute time, in UTC, for people: "2026-11-27T20:15:03.250Z". The clocks of a run begin with it, so lines of
/// the log can be compared with the rest of the world by this only. In virtual time it says when a line was written.
/// @param moment  of the log's clock (set_clock()); else it is the present.
/// @thread  any, but not in a Listener's function.
[[nodiscard]] std::string wall_time_text(TimePoint moment);
[[nodiscard]] std::string wall_time_text();

}  // namespace orca::log
