// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::sim::detail {

// Returns the pose at `share` (0 to 1) of the way from `a` to `b`, for something that moves evenly.
[[nodiscard]] inline Pose2 between(const Pose2& a, const Pose2& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrapped(a.yaw + share * wrapped(b.yaw - a.yaw))};
}

// One tick of the simulation, (from, to], with the poses of a sensor's carrier at both ends. The carrier is
// the base or its turret.
struct TickSpan {
  TimePoint from, to;
  Pose2 X_from, X_to;
  Pose2 robot_from{}, robot_to{};  // The robot's frame. It differs on a synchro base and below a turret.

  // Returns the carrier's pose in the world at `t`, assuming that it moves evenly.
  [[nodiscard]] Pose2 at(TimePoint t) const { return between(X_from, X_to, share(t)); }
  // Returns the carrier's pose in the robot's frame at `t`, assuming that both move evenly.
  [[nodiscard]] Pose2 in_robot(TimePoint t) const {
    if (X_from == robot_from && X_to == robot_to) return {};
    return inverse(between(robot_from, robot_to, share(t))) * at(t);
  }

 private:
  [[nodiscard]] double share(TimePoint t) const { return to_seconds(t - from) / to_seconds(to - from); }
};

}  // namespace orca::sim::detail
