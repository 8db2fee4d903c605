// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <tuple>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::nav {

/// The poses of a robot in the last moments, for readings that were taken at other instants than any pose.
///
/// Thread contract: as for a container: const functions from any thread, others need exclusive access.
class PoseHistory {
 public:
  /// Adds a pose. One that is not newer than the last clears the history first.
  void add(TimePoint stamp, const Pose2& pose);
  void clear() { poses_.clear(); }
  [[nodiscard]] bool empty() const { return poses_.empty(); }
  /// Names what it consists of.
  [[nodiscard]] auto state() { return std::tie(poses_); }
  /// Returns when the newest pose was. @pre not empty.
  [[nodiscard]] TimePoint newest() const { return poses_.back().stamp; }
  /// Returns the pose at an instant, on the straight line between its neighbours; nothing if it is not between two poses.
  [[nodiscard]] std::optional<Pose2> at(TimePoint stamp) const;

 private:
  static constexpr std::size_t kMost = 64;
  struct Stamped {
    TimePoint stamp;
    Pose2 pose;
  };
  std::deque<Stamped> poses_;  // oldest first
};

/// Returns the pose at a share [1] of the straight way between two poses.
/// @thread  pure function; any thread.
[[nodiscard]] inline Pose2 between(const Pose2& from, const Pose2& to, double share) {
  const Vec2 place = from.position() + share * (to.position() - from.position());
  return {place.x, place.y, wrapped(from.yaw + share * wrapped(to.yaw - from.yaw))};
}

}  // namespace orca::nav
