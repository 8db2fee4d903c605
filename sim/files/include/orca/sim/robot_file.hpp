// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/sim/robot_model.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::sim {

/// Reads a robot: a URDF file with one <orca> element inside <robot> (docs/robot-files.md). The URDF's root
/// link is the base frame, on the floor; moving joints stand at zero. robots::read_robot() reads all but the solid body.
///
/// @param diagnostics  receives all errors at once, each with file, line and column (codes R001 ...).
/// @return nothing if there was any error.
[[nodiscard]] std::optional<RobotModel> read_robot(const std::string& path, xml::Diagnostics& diagnostics);

/// Reads a robot from text in memory; `file_name` only appears in positions.
[[nodiscard]] std::optional<RobotModel> read_robot_text(std::string_view text, const std::string& file_name,
                                                        xml::Diagnostics& diagnostics);

}  // namespace orca::sim
