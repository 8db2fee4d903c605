// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "orca/avoidance/echo_memory.hpp"

namespace orca::avoid {

struct Limits {
  double robot_radius = 0.0;   ///< [m] of the circle that holds the robot.
  double margin = 0.0;         ///< [m] kept free on both sides of it.
  double side_distance = 0.0;  ///< [m] an echo nearer to the body than this counts as a wall across the beam;
                               ///< 0: only one within the body.
  double safe_distance = 0.0;  ///< [m] free way ahead from which on there is nothing to avoid.
  double stop_distance = 0.0;  ///< [m] free way ahead at which the robot does not drive on.
  double max_speed = 0.0;      ///< [m/s] with a free way of safe_distance.
};

/// The other things that an advice depends on.
struct Situation {
  /// [rad] advised in the lap before, 0 if none. The side once chosen is kept, so that the robot does not
  /// dither in front of something symmetric.
  double last_direction = 0.0;
  /// [rad] how far the robot will have turned before it can follow the advice. Everything within this angle
  /// also counts as ahead.
  double turning = 0.0;
  /// [rad] robot frame, direction of the goal, if known: the free direction nearest to it is chosen.
  std::optional<double> goal = {};
  /// [rad] where the robot points, in a frame that does not turn with it; 0 if it does not know.
  double heading = 0.0;
  double speed = 0.0;  ///< [m/s] at which it drives, forward positive; 0 if it does not know.
  double goal_distance = std::numeric_limits<double>::infinity();  ///< [m] to the goal, if known.
};

/// What the robot should do: nothing, or drive in a direction.
struct Advice {
  bool needed = false;
  double direction = 0.0;  ///< [rad] robot frame, counter-clockwise positive.
  double speed = 0.0;      ///< [m/s]
  double urgency = 0.0;    ///< [0, 1] 0 at safe_distance, 1 at stop_distance.
};

/// Returns how far [m] the robot can go straight in a direction before its body, with margin, touches an
/// echo; at most safe_distance.
///
/// A smooth wall that the robot nears at a flat angle reflects only the sonar beam that meets it squarely.
/// Nothing is heard from the place where the robot will touch it. Therefore a near echo stands for a wall
/// across its beam.
[[nodiscard]] double free_way(std::span<const Vec2> echoes, double direction, const Limits& limits);

/// Returns how far [m] the way ahead is free: straight on and where the robot will have turned to, whichever is
/// shorter; at most safe_distance.
[[nodiscard]] double way_ahead(std::span<const Vec2> echoes, const Situation& situation,
                               const Limits& limits);

/// Returns how much of the speed a free way [m] leaves, in [0, 1]: all of it from safe_distance on, nothing from
/// stop_distance down.
[[nodiscard]] double room(double way, const Limits& limits);

/// Steers to the nearest direction with a long enough free way when the way ahead is blocked.
[[nodiscard]] Advice avoid(std::span<const Vec2> echoes, const Situation& situation, const Limits& limits);

}  // namespace orca::avoid
