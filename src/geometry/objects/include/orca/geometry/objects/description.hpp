// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/result.hpp"
#include "orca/idl/hardware.hpp"

namespace orca {

/// Checks whether a base describes a robot that there can be: of a size, with speeds and intervals that are numbers in SI units. Who drives by a
/// description of no size would take the robot for a point.
/// @errors  invalid_argument, with what was found and what was expected.
/// @thread  pure function; any thread.
[[nodiscard]] Status check_description(const idl::Robot& robot);

}  // namespace orca
