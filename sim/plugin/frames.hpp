// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/idl/geometry.hpp"
#include "orca/sim/geometry.hpp"

namespace orca::sim {

/// A pose in the plane, `height` [m] above the floor, as a frame in space.
inline idl::Frame3D frame(const Pose2& pose, double height) {
  idl::Frame3D frame;
  frame.position().x(pose.x);
  frame.position().y(pose.y);
  frame.position().z(height);
  frame.rotation().yaw(pose.yaw);
  return frame;
}

}  // namespace orca::sim
