// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trail.hpp"

#include <cmath>

namespace orca::sim::detail {

void Trail::add(const RobotSnapshot::Sample& now) {
  const Pose2& last = samples_.back().pose;
  if (norm(now.pose.position() - last.position()) < way_ &&
      std::fabs(wrapped(now.pose.yaw - last.yaw)) < turn_)
    return;
  if (samples_.size() == kMost) thin_out();
  samples_.push_back(now);
}

// Keeps every second pose, the first among them. A step of a whole turn is never reached, so that later only way counts.
void Trail::thin_out() {
  for (std::size_t i = 1; 2 * i < samples_.size(); ++i) samples_[i] = samples_[2 * i];
  samples_.resize((samples_.size() + 1) / 2);
  way_ *= 2.0;
  turn_ *= 2.0;
}

}  // namespace orca::sim::detail
