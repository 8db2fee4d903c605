// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "orca/geometry/pose2.hpp"

namespace orca::doors {

/// The free part of a doorway, across it: y in the frame of the door, whose origin is the middle of the opening and whose x axis leads through it.
struct Gap {
  double middle = 0.0;  ///< [m]
  double width = 0.0;   ///< [m]
};

/// Finds the gap between what a scan shows in a doorway: jambs, a leaf, somebody who stands there.
/// @param points  of echoes, in the frame of the door.
/// @param width [m]  of the opening as the map has it; the gap is not looked for farther aside than 0.3 m.
/// @return nothing if not both sides of it were seen.
/// @thread  pure function; any thread.
[[nodiscard]] std::optional<Gap> gap_in(std::span<const Vec2> points, double width);

/// One step on the way through a door.
struct Step {
  double speed = 0.0;      ///< [m/s]
  double turn_rate = 0.0;  ///< [rad/s]
};

/// Computes how a robot that turns on the spot lines up before a door.
/// @param robot    its pose in the frame of the door, before it: x < 0.
/// @param middle   [m] of the gap.
/// @param run_up   [m] before the door at which it lines up.
/// @param speed    [m/s] at most.
/// @return nothing if it is lined up: on the axis to within 3 cm and 2 degrees, so that it may drive through.
[[nodiscard]] std::optional<Step> line_up(const Pose2& robot, double middle, double run_up, double speed);

/// Computes how a robot that is lined up drives along the axis of the gap.
[[nodiscard]] Step pass(const Pose2& robot, double middle, double speed);

}  // namespace orca::doors
