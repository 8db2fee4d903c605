// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/time.hpp"
#include "orca/sim/geometry.hpp"

namespace orca::sim::detail {

// One tick of the simulation, (from, to], and where the base was at its ends.
struct TickSpan {
  TimePoint from, to;
  Pose2 X_from, X_to;

  // Where the base was at `t`, taken to move evenly.
  [[nodiscard]] Pose2 at(TimePoint t) const {
    const double share = to_seconds(t - from) / to_seconds(to - from);
    return {X_from.x + share * (X_to.x - X_from.x), X_from.y + share * (X_to.y - X_from.y),
            wrapped(X_from.yaw + share * wrapped(X_to.yaw - X_from.yaw))};
  }
};

}  // namespace orca::sim::detail
