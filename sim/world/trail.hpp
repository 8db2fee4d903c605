// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/sim/snapshot.hpp"

namespace orca::sim::detail {

// Where a robot has been, for pictures: one pose per step of way or turn. The steps double whenever there are too many
// poses, so that a run of any length takes no more memory (512 KiB) than that.
class Trail {
 public:
  static constexpr std::size_t kMost = 16384;  // Poses.

  explicit Trail(const RobotSnapshot::Sample& first) : samples_{first} {}

  // Keeps the pose if it is a step away from the last one that was kept.
  void add(const RobotSnapshot::Sample& now);

  [[nodiscard]] const std::vector<RobotSnapshot::Sample>& samples() const { return samples_; }

 private:
  void thin_out();

  double way_ = 0.05;  // [m] Of one step.
  double turn_ = 0.2;  // [rad] Of one step.
  std::vector<RobotSnapshot::Sample> samples_;
};

}  // namespace orca::sim::detail
