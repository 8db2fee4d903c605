// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/geometry/pose2.hpp"
#include "orca/goals/route.hpp"
#include "orca/idl/navigation.hpp"

namespace orca::go {

/// Fills in the way that is left: the robot's pose, then the points of the route, which give the path its name. A
/// pose on the way looks along the way that leads to it, and the last one as the goal asks. Without a route the path
/// is empty. The uncertainties of the points are left out.
/// @param here  of the robot, in the frame of the points.
/// @param height [m]  of the robot in that frame.
void fill_path(const Route& route, const Pose2& here, double height, idl::Path& path);

}  // namespace orca::go
