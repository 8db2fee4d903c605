// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Geometry and world geometry (thesis 8.2): Point, Rotation3D, Frame3D, WDistance, Pose2D, ...
/// idl/orca/geometry.idl gives the meaning, unit and frame of each field, and says which of them travel.
#pragma once

#include "orca/idl/generated/geometry.h"
#include "orca/idl/generated/geometry.types.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/time.hpp"

namespace orca {

/// @param x, y, z [m]  in the frame that the user of the point names.
[[nodiscard]] inline idl::Point make_point(double x, double y, double z) {
  idl::Point point;
  point.x(x);
  point.y(y);
  point.z(z);
  return point;
}

/// Returns the frame of a part that is mounted level.
/// @param position  of the part's origin in the other frame.
/// @param yaw [rad]  of the part's x axis in the other frame, positive to the left.
[[nodiscard]] inline idl::Frame3D make_frame(const idl::Point& position, double yaw) {
  idl::Frame3D frame;
  frame.position(position);
  frame.rotation().yaw(yaw);
  return frame;
}

}  // namespace orca
