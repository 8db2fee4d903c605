// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/steady_clock.hpp"

namespace orca {
namespace {

// Reads both clocks of the system some times. A thread may lose its processor in between, so the reading that took least counts.
Duration read_epoch() {
  constexpr int kReadings = 8;
  Duration least = Duration::max();
  Duration epoch{};
  for (int i = 0; i < kReadings; ++i) {
    const auto before = std::chrono::steady_clock::now();
    const auto wall = std::chrono::system_clock::now();
    const Duration took = std::chrono::steady_clock::now() - before;
    if (took >= least) continue;
    least = took;
    epoch = wall.time_since_epoch() - (before + took / 2).time_since_epoch();
  }
  return epoch;
}

Duration g_epoch = read_epoch();

}  // namespace

TimePoint steady_now() { return TimePoint(std::chrono::steady_clock::now().time_since_epoch() + g_epoch); }

std::chrono::steady_clock::time_point to_steady(TimePoint time) {
  return std::chrono::steady_clock::time_point(time.time_since_epoch() - g_epoch);
}

Duration steady_epoch() { return g_epoch; }

void set_steady_epoch(Duration wanted) { g_epoch = wanted; }

}  // namespace orca
