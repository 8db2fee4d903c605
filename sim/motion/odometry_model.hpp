// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/random.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"
#include "wheel_model.hpp"

namespace orca::sim::detail {

// Dead reckoning: the readings of the wheels' encoders, integrated by the exact arc model.
class OdometryModel {
 public:
  OdometryModel(const Drive& drive, const ErrorLevels& errors, RandomStream random)
      : random_(random), wheels_(drive, WheelErrors::drawn(drive.kind, errors, random_)) {}
  // Uses the given errors instead of drawn ones.
  OdometryModel(const Drive& drive, const WheelErrors& errors, RandomStream random)
      : random_(random), wheels_(drive, errors) {}

  // Adds a motion of the base that took `seconds`.
  void add(const Travel2& real, double seconds);

  [[nodiscard]] OdometryReading reading(TimePoint stamp) const { return {stamp, pose_, velocity_}; }

 private:
  RandomStream random_;
  WheelModel wheels_;
  Pose2 pose_;
  Twist2 velocity_;
};

}  // namespace orca::sim::detail
