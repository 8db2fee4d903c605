// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "orca/avoidance/echo_memory.hpp"

namespace orca::avoid {

/// A body that is longer than wide: the rectangle that holds it, around the origin of the robot's frame, x along it. It passes
/// where the circle around it does not, but cannot turn there.
struct Rectangle {
  double half_length = 0.0;  ///< [m]
  double half_width = 0.0;   ///< [m]
};

/// Returns the rectangle of that length and width [m]; nothing if one of them is not known, which is 0.
[[nodiscard]] std::optional<Rectangle> rectangle(double length, double width);

struct Limits {
  double robot_radius = 0.0;   ///< [m] of the circle that holds the robot.
  double margin = 0.0;         ///< [m] kept free on both sides of it.
  double side_distance = 0.0;  ///< [m] an echo nearer to the body than this counts as a wall across the beam;
                               ///< 0: only one within the circle.
  double safe_distance = 0.0;  ///< [m] free way ahead from which on there is nothing to avoid.
  double stop_distance = 0.0;  ///< [m] free way ahead at which the robot does not drive on.
  double max_speed = 0.0;      ///< [m/s] with a free way of safe_distance.
  /// If given, the robot does not turn its corners into anything.
  std::optional<Rectangle> body = {};
  double turn_margin = 0.03;  ///< [m] kept free of those corners.
  /// Whether it passes wherever half the body's width, with margin, finds room.
  bool squeezes = false;
  /// Whether the way to the goal counts as well as the way ahead. A behaviour that has turned the robot away and falls silent,
  /// because the way ahead is free now, is turned back by the one that drives to the goal.
  bool watches_goal = false;
  /// Whether the robot moves in any direction without turning to it. Then its circle counts, whatever its body.
  bool slides = false;
};

/// Returns the way that a robot needs to stop [m]; 0 if its acceleration is not known, which is 0.
/// @param speed  [m/s]  @param reaction  time until it slows down [s]  @param acceleration  [m/s2] at which it then does
[[nodiscard]] double braking_way(double speed, double reaction, double acceleration);

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
  double speed = 0.0;      ///< [m/s] at which it drives, forward positive; 0 if it does not know.
  double turn_rate = 0.0;  ///< [rad/s] at which it turns, positive to the left; 0 if it does not know.
  double goal_distance = std::numeric_limits<double>::infinity();  ///< [m] to the goal, if known.
  double goal_reach = 0.0;   ///< [m] from the goal at which it counts as reached, if known.
  bool passes_goal = false;  ///< Whether the goal is a point on the way, where the robot does not stop.
  Vec2 place = {};           ///< [m] Of the robot, in the frame of `heading`; the origin if it does not know.
  bool is_heeded = true;     ///< Whether anybody takes the advice.
  std::optional<double> course = {};  ///< [rad] robot frame, in which it moves; nothing if it stands.
};

/// The advice to a robot: nothing, or to drive in a direction or along an arc.
struct Advice {
  bool needed = false;
  double direction = 0.0;  ///< [rad] robot frame, counter-clockwise positive.
  double speed = 0.0;      ///< [m/s]
  double urgency = 0.0;    ///< [0, 1] 0 at safe_distance, 1 at stop_distance.
  /// [rad/s] if given, the robot turns at this rate; the direction gives the side only.
  std::optional<double> turn_rate = {};
  /// Whether the echoes are to be forgotten: the robot may be elsewhere now.
  bool forgets = false;
  bool slides = false;  ///< Whether it is to move in the direction without turning to it.
};

/// Returns how far [m] the robot can go straight in a direction before its body, with margin, touches an
/// echo; at most safe_distance.
///
/// A smooth wall that the robot nears at a flat angle reflects only the sonar beam that meets it squarely.
/// Nothing is heard from the place where the robot will touch it. Therefore a near echo stands for a wall
/// across its beam.
[[nodiscard]] double free_way(std::span<const Vec2> echoes, double direction, const Limits& limits);

/// Adds what a laser may not see of things that stand alone. A mast, a chair or another robot is wider below or above the height at which
/// the laser looks, and may come nearer. Each thing that is less than 0.45 m across, and has nothing else within 0.8 m, becomes wider to
/// both sides, across its beams.
/// @param foot [m]  by which it becomes wider to each side.
/// @param all  the echoes, robot frame; afterwards also those beside things that stand alone.
void add_feet(std::vector<Vec2>& all, double foot);

/// The turns on the spot that a robot can make before a corner of its body touches an echo [rad]; both are positive.
struct TurnRoom {
  double left = std::numeric_limits<double>::infinity();
  double right = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool allows(double angle) const { return angle <= left && -angle <= right; }
  /// Returns the angle if there is room for it, else 0.
  [[nodiscard]] double allowed(double angle) const { return allows(angle) ? angle : 0.0; }
};

/// Returns the room to turn, less what the robot turns before it can follow the advice. A circle has it always.
[[nodiscard]] TurnRoom turn_room(std::span<const Vec2> echoes, const Situation& situation,
                                 const Limits& limits);

/// Returns how far [m] the way ahead is free: straight on and where the robot will have turned to, whichever is
/// shorter; at most safe_distance.
[[nodiscard]] double way_ahead(std::span<const Vec2> echoes, const Situation& situation,
                               const Limits& limits);

/// Returns how far [m] the way to the goal is free; safe_distance if it leads there, or if there is no goal.
[[nodiscard]] double way_to_goal(std::span<const Vec2> echoes, const Situation& situation,
                                 const Limits& limits);

/// Returns whether the robot should go where only its body fits, because ways for its circle lead much farther off, or nowhere.
/// @pre  limits.body.
[[nodiscard]] bool should_squeeze(std::span<const Vec2> echoes, const Situation& situation, Limits limits);

/// Returns how much of the speed a free way [m] leaves, in [0, 1]: all of it from safe_distance on, nothing from
/// stop_distance down.
[[nodiscard]] double room(double way, const Limits& limits);

/// Returns how urgent advice is, in [0, 1]: the more the shorter the way is, and all but fully if a body cannot turn to its goal,
/// since whoever drives to the goal would turn it.
[[nodiscard]] double urgency(double way, bool may_turn, const Limits& limits);

/// Steers to the nearest direction with a long enough free way when the way ahead is blocked, or when turning to the goal
/// would touch something. To a robot that slides, ahead is where its goal is, without one where it moves.
[[nodiscard]] Advice avoid(std::span<const Vec2> echoes, const Situation& situation, const Limits& limits);

}  // namespace orca::avoid
