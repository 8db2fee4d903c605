// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::sim::detail {

// Between two poses, for something that moves evenly.
[[nodiscard]] inline Pose2 between(const Pose2& a, const Pose2& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrapped(a.yaw + share * wrapped(b.yaw - a.yaw))};
}

// One tick of the simulation, (from, to], and where what carries a sensor was at its ends: the base, or its
// turret.
struct TickSpan {
  TimePoint from, to;
  Pose2 X_from, X_to;
  Pose2 robot_from{}, robot_to{};  // The robot's frame: another one on a synchro base, and below a turret.

  // Where the carrier was at `t`, taken to move evenly.
  [[nodiscard]] Pose2 at(TimePoint t) const { return between(X_from, X_to, share(t)); }
  // The same, in the robot's frame.
  [[nodiscard]] Pose2 in_robot(TimePoint t) const {
    if (X_from == robot_from && X_to == robot_to) return {};
    return inverse(between(robot_from, robot_to, share(t))) * at(t);
  }

 private:
  [[nodiscard]] double share(TimePoint t) const { return to_seconds(t - from) / to_seconds(to - from); }
};

}  // namespace orca::sim::detail
