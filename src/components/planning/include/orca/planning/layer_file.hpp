// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/navigation/floor_rules.hpp"

namespace orca::planning {

/// Reads a layer of rules that lies over a map: zones to keep out of, slow zones and lanes, in the frame of the goals. The README of
/// PathPlanner says what its elements mean.
/// @errors  invalid_argument with all that is wrong with the file, each with line and column.
/// @thread  any.
[[nodiscard]] Result<nav::FloorRules> read_layer(const std::string& file);

}  // namespace orca::planning
