// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "orca/base/time.hpp"

namespace orca {

/// The cores of a computer, on which the laps of several components compute, one lap on each at a time. It serves virtual time.
///
/// Thread contract: tasks that do not overlap.
class Cores {
 public:
  /// @param count  at least 1.
  explicit Cores(std::size_t count) : free_at_(count) {}

  /// Puts a lap on the core that is free first, behind the laps that asked before. It computes to its end there.
  /// @return when it is over.
  TimePoint reserve(TimePoint now, Duration time) {
    TimePoint& core = *std::ranges::min_element(free_at_);
    core = saturating_add(std::max(core, now), time);
    return core;
  }

 private:
  std::vector<TimePoint> free_at_;
};

}  // namespace orca
