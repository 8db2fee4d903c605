// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/xr4000/odometry.hpp"

namespace orca::hw::xr4000 {

void IntegratorOdometry::add(const Axes& integrator) {
  const Pose2 counted = pose_of(integrator);
  if (!origin_) origin_ = pose_ * inverse(counted);
  pose_ = *origin_ * counted;
}

}  // namespace orca::hw::xr4000
