// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/robot_file/devices.hpp"
#include "orca/robot_file/link_tree.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::robot_file {

/// The content of a robot's file for those who drive the robot. Lasers and gripper have their places, other devices
/// have not. A plain value.
struct Figures : Devices {
  std::optional<Vec2> size{};     ///< [m] Length and width of its plan; 0: it is round; nothing: not known.
  std::vector<BodyPart> parts{};  ///< Its solids; none: not known.
  /// The paddles of its gripper, open, in all heights to which the lift takes them.
  std::vector<BodyPart> paddles{};
  std::vector<BodyPart> load{};  ///< The room of what the gripper holds.
  std::string usual;  ///< Figures that the file lacks, and those that are taken instead, for people.
};

/// Returns the open paddles of a gripper whose place is known, from the floor to where they reach when the lift is so high.
/// @param raised  [m] of the lift.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<BodyPart> paddles_of(const Gripper& gripper, double raised);

/// Reads a robot file (docs/robot-files.md).
/// @param diagnostics  gets what is wrong.
/// @return the figures; nothing if something is wrong.
/// @thread  any.
[[nodiscard]] std::optional<Figures> read_figures(const std::string& path, xml::Diagnostics& diagnostics);

}  // namespace orca::robot_file
