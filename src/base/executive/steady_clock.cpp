// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/steady_clock.hpp"

namespace orca {
namespace {

Duration& epoch() {
  static Duration epoch = std::chrono::system_clock::now().time_since_epoch() -
                          std::chrono::steady_clock::now().time_since_epoch();
  return epoch;
}

}  // namespace

TimePoint steady_now() { return TimePoint(std::chrono::steady_clock::now().time_since_epoch() + epoch()); }

std::chrono::steady_clock::time_point to_steady(TimePoint time) {
  return std::chrono::steady_clock::time_point(time.time_since_epoch() - epoch());
}

Duration steady_epoch() { return epoch(); }

void set_steady_epoch(Duration wanted) { epoch() = wanted; }

}  // namespace orca
