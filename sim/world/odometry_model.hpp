// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/random.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// What wheel encoders make of the true motion: each wheel's travel, with this robot's wrong diameters, wrong
// track and slip, integrated by the exact arc model. Sideways motion (being pushed) turns no wheel and goes
// unseen.
class OdometryModel {
 public:
  OdometryModel(const Drive& drive, const ErrorLevels& errors, RandomStream random);

  // The base went `travel` [m] forward and turned `turn` [rad] in `seconds`.
  void add(double travel, double turn, double seconds);

  [[nodiscard]] OdometryReading reading(TimePoint stamp) const { return {stamp, pose_, velocity_}; }

 private:
  double measured(double travel, double diameter_error);

  RandomStream random_;
  double slip_;
  double track_;           // True [m].
  double believed_track_;  // What the integration uses [m].
  double left_error_;      // Relative, of the wheel's diameter.
  double right_error_;
  Pose2 pose_;
  Velocity velocity_;
};

}  // namespace orca::sim::detail
