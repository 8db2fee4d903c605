// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>

#include "orca/geometry/angle.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::turret {

/// Returns the direction in which a turret is to be pointed now [rad], robot frame, in (-pi, pi]: while the robot moves, ahead of where it points by
/// itself, so that it goes on turning; while the robot rests, ahead of the robot.
/// @param twist        how the robot moves.
/// @param angle [rad]  in which the turret points now, robot frame.
/// @param lead [rad]   angle from there to where it is to be pointed, to the left if positive; less than half a turn, because a turret turns the
///                     shorter way.
/// @thread  pure function; any thread.
[[nodiscard]] inline double next_angle(const Twist2& twist, double angle, double lead) {
  constexpr double kSlow = 0.01;      // [m/s] Slower, it rests.
  constexpr double kSlowTurn = 0.02;  // [rad/s]
  const bool moves = speed_of(twist) > kSlow || std::fabs(twist.turn_rate) > kSlowTurn;
  return moves && lead != 0.0 ? wrapped(angle + lead) : 0.0;
}

}  // namespace orca::turret
