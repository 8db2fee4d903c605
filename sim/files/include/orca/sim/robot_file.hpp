// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/sim/robot_model.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::sim {

/// Reads a robot: a URDF file with one <orca> element inside <robot> (docs/robot-files.md). The URDF's root
/// link is the base frame, on the floor; moving joints stand at zero.
///
/// @param diagnostics  receives all errors and warnings at once, each with file, line and column (codes R001 ...).
/// @param packages     folder that holds the packages of meshes named package://PACKAGE/...; empty: they are looked for
///                     around the file.
/// @return nothing if there was any error.
[[nodiscard]] std::optional<RobotModel> read_robot(const std::string& path, xml::Diagnostics& diagnostics,
                                                   const std::string& packages = {});

/// Reads a robot from text in memory; `file_name` only appears in positions.
[[nodiscard]] std::optional<RobotModel> read_robot_text(std::string_view text, const std::string& file_name,
                                                        xml::Diagnostics& diagnostics,
                                                        const std::string& packages = {});

}  // namespace orca::sim
