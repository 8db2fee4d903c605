// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/geometry/arc.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/sim/readings.hpp"

namespace orca::sim::detail {

// Dead reckoning: what the encoders of the wheels report, integrated by the exact arc with the dimensions that
// the robot assumes.
class OdometryModel {
 public:
  // Adds what the encoders reported in a tick of `seconds`.
  void add(const Travel2& rolled, double seconds) {
    pose_ = along_arc(pose_, rolled);
    velocity_ = rolled / seconds;
  }

  [[nodiscard]] OdometryReading reading(TimePoint stamp) const { return {stamp, pose_, velocity_}; }

 private:
  Pose2 pose_;
  Twist2 velocity_;
};

}  // namespace orca::sim::detail
