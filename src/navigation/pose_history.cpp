// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/pose_history.hpp"

#include <algorithm>

namespace orca::nav {

void PoseHistory::add(TimePoint stamp, const Pose2& pose) {
  if (!poses_.empty() && stamp <= newest()) poses_.clear();
  if (poses_.size() == kMost) poses_.pop_front();
  poses_.push_back({stamp, pose});
}

std::optional<Pose2> PoseHistory::at(TimePoint stamp) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp,
                                      [](const Stamped& one, TimePoint time) { return one.stamp < time; });
  if (after == poses_.end()) return std::nullopt;
  if (after->stamp == stamp) return after->pose;
  if (after == poses_.begin()) return std::nullopt;
  const auto before = after - 1;
  const double share = to_seconds(stamp - before->stamp) / to_seconds(after->stamp - before->stamp);
  return between(before->pose, after->pose, share);
}

}  // namespace orca::nav
