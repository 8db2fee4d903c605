// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/component/host.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/robot_file/devices.hpp"

namespace orca::hw {

/// What a driver knows of its robot from the file that the simulator reads, too (docs/robot-files.md). Of all devices only lasers have their
/// places. A plain value.
struct RobotFigures : robot_file::Devices {
  std::optional<Vec2> size{};  ///< [m] Length and width of its plan; 0: it is round; nothing: not known.
  std::string usual;  ///< What the file does not say and is taken instead, for people; empty: nothing.

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
