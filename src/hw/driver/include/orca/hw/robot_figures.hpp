// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/component/host.hpp"
#include "orca/robot_file/figures.hpp"

namespace orca::hw {

/// What a driver knows of its robot from the file that the simulator reads, too. A plain value.
struct RobotFigures : robot_file::Figures {
  /// Returns the directions [rad] in which the bumpers of all rings face.
  [[nodiscard]] std::vector<double> bumper_directions() const;
};

/// Reads a robot file.
/// @param path    empty: there is none, and nothing is wrong.
/// @param faults  gets what is wrong, as faults of the parameter `robot`.
/// @return the figures; nothing without a file, and if something is wrong.
/// @thread  any.
[[nodiscard]] std::optional<RobotFigures> read_robot_figures(const std::string& path,
                                                             std::vector<HardwareFault>& faults);

}  // namespace orca::hw
