// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include "orca/geometry/vec2.hpp"

namespace orca::wall {

enum class Side { left, right };

struct Limits {
  Side side = Side::left;  ///< The robot has the wall on this side.
  double radius = 0.0;     ///< [m] of the circle that holds the robot.
  double distance = 0.0;   ///< [m] to keep between that circle and the wall.
  double least = 0.0;      ///< [m] the same where there is not so much room.
  double max_speed = 0.0;  ///< [m/s]
};

/// The motion of the next moment.
struct Step {
  double direction = 0.0;  ///< [rad] robot frame, counter-clockwise positive.
  double speed = 0.0;      ///< [m/s] 0: it turns on the spot.
  bool follows = false;    ///< Whether there is a wall; else it looks for one.
};

/// Length [m] of the step for which a direction is chosen. Where the robot is farther off than it should be by a part of it, it drives
/// to the wall at an angle whose sine is that part.
constexpr double kStep = 0.5;

/// Chooses a direction along a wall. The circle around the robot that is to be free rolls along it: turning from the nearest thing
/// on the wall's side away from it, the first direction is taken in which the circle touches nothing after a step.
///
/// An echo of a sonar stands for a wall across its beam, as a smooth wall sends nothing back from ahead. So corners, outer and inner, need
/// no rule of their own, and openings into which the circle does not fit are passed. Where it fits nowhere, the robot keeps to the
/// direction nearest to straight on in which the smaller distance is left, and turns away from the wall where there is none.
/// Without a wall it drives straight on.
///
/// @param echoes  robot frame [m].
/// @source  Our own; the rolling circle is Bug's boundary (Lumelsky and Stepanov, "Path-Planning Strategies for a Point Mobile
///          Automaton Moving Amidst Unknown Obstacles of Arbitrary Shape", Algorithmica 2, 1987).
/// @thread  pure function; any thread.
[[nodiscard]] Step step_along(std::span<const Vec2> echoes, const Limits& limits);

}  // namespace orca::wall
