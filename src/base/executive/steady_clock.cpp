// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/steady_clock.hpp"

namespace orca {
namespace {

Duration g_epoch =
    std::chrono::system_clock::now().time_since_epoch() - std::chrono::steady_clock::now().time_since_epoch();

}  // namespace

TimePoint steady_now() { return TimePoint(std::chrono::steady_clock::now().time_since_epoch() + g_epoch); }

std::chrono::steady_clock::time_point to_steady(TimePoint time) {
  return std::chrono::steady_clock::time_point(time.time_since_epoch() - g_epoch);
}

Duration steady_epoch() { return g_epoch; }

void set_steady_epoch(Duration wanted) { g_epoch = wanted; }

}  // namespace orca
