// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/hw/xr4000/base.hpp"

namespace orca::hw::xr4000 {

/// The pose of the robot by its integrator. It begins at 0, and after forget() it goes on from where it was.
///
/// Thread contract: not synchronised.
class IntegratorOdometry {
 public:
  /// Takes what the integrator says. The first one after forget() moves nothing.
  void add(const Axes& integrator);
  /// Makes the next value a new reference: after the connection was opened again, or set_integrator().
  void forget() { origin_.reset(); }
  /// Returns the pose in the frame of the odometry.
  [[nodiscard]] const Pose2& pose() const { return pose_; }

 private:
  std::optional<Pose2> origin_;  // of the integrator's frame in that of the odometry
  Pose2 pose_;
};

}  // namespace orca::hw::xr4000
