// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/idl/navigation.hpp"

namespace orca::go {

/// Returns why a robot on the floor cannot take that goal, to be read after "it"; null if it can. The uncertainties of
/// the goal are not considered.
/// @param height [m]  of the robot in the frame of the goal.
[[nodiscard]] const char* fault_of(const idl::GoalPoint& goal, double height);

/// Returns why the robot cannot go through that door; null if it can. A width of 0 is not known.
/// @param room [m]  width that the robot needs.
[[nodiscard]] const char* fault_of_door(const idl::Door& door, double room);

}  // namespace orca::go
