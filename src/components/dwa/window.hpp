// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "orca/avoidance/footprint.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/geometry/vec2.hpp"

/// The Dynamic Window Approach as pure functions of any thread: which of the velocities that the robot can reach is best.
///
/// Sets of velocities and terms have the names of D. Fox, W. Burgard and S. Thrun, "The Dynamic Window Approach to Collision
/// Avoidance", IEEE Robotics & Automation Magazine 4(1), 1997. Places are in the robot's frame [m], x forward.
namespace orca::dwa {

using avoid::Footprint;

/// The abilities of the robot.
struct Abilities {
  double max_speed = 0.0;          ///< [m/s] with max_turn_rate it bounds the velocities V_s.
  double max_turn_rate = 0.0;      ///< [rad/s] to either side.
  double acceleration = 0.0;       ///< [m/s2] above 0; also of braking.
  double turn_acceleration = 0.0;  ///< [rad/s2] above 0; also of braking.

  [[nodiscard]] avoid::Brakes brakes() const { return {acceleration, turn_acceleration}; }
};

/// The weights of the objective function G.
struct Weights {
  double heading = 0.0;   ///< alpha
  double distance = 0.0;  ///< beta
  double speed = 0.0;     ///< gamma
};

/// The settings, which do not change from lap to lap.
struct Settings {
  Abilities robot;
  Weights weights;
  double interval = 0.0;      ///< [s] t: time in which a velocity must be reachable, above 0.
  double reaction = 0.0;      ///< [s] after which the robot begins to brake.
  double far = 0.0;           ///< [m] a free way of this or more counts as much as any, above 0.
  Footprint body;             ///< Without margin.
  double margin = 0.0;        ///< [m] kept free around it at max_speed.
  double least_margin = 0.0;  ///< [m] the same at rest; in between in proportion to the speed.
};

/// The surroundings of the robot.
struct Scene {
  std::span<const Vec2> echoes;
  Vec2 target;                        ///< The place to drive to; without one, a place straight ahead.
  std::optional<double> stop_within;  ///< [m] way to the place where the robot must be able to stand, if any.
};

/// The robot's velocities, each at most once.
struct Window {
  std::vector<double> speeds;      ///< [m/s] ascending.
  std::vector<double> turn_rates;  ///< [rad/s] ascending.
};

/// The way that the robot can go on with a velocity.
struct Room {
  double time = 0.0;  ///< [s] left to brake before it touches something; infinity: it never does.
  double distance =
      0.0;  ///< [m] the way of the point of the body that is farthest from its centre until then.
};

/// Returns the velocities that the robot can reach from the present one within the interval: V_s and V_d, as a
/// grid. If the turn rate 0 is among them, it is on the grid.
[[nodiscard]] Window window_around(const Twist2& now, double max_speed, const Settings& settings);

/// Returns how far the robot can go on with a velocity before an echo is nearer than the margin of its speed. An echo that is
/// nearer already keeps the robot from coming nearer still. A velocity from which it can stop within that time is admissible: V_a.
[[nodiscard]] Room room_on(const Twist2& motion, std::span<const Vec2> echoes, const Settings& settings);

/// Returns how well the robot points to the target, in [0, 1], when it brakes with all its might after the next interval: the term
/// `heading` of the objective function, 1 - theta / pi.
[[nodiscard]] double heading(const Twist2& motion, Vec2 target, const Settings& settings);

/// Returns the best velocity: of those that the robot can reach (V_d) and stop from (V_a), altogether V_r,
/// that with the largest value of the smoothed objective function. Returns nothing if it can stop from none.
///
/// Standing is no candidate: its way would always be free.
/// @param now  the present velocity, forward or at rest.
/// @param least_way [m]  velocities that lead forward are no candidates with a shorter way.
[[nodiscard]] std::optional<Twist2> best_velocity(const Twist2& now, const Scene& scene, double least_way,
                                                  const Settings& settings);

/// Returns the fastest turn on the spot that the robot can reach and stop from; nothing if it does not come to rest within the
/// interval, or if there is no room to turn.
/// @param side  above 0: to the left, below 0: to the right.
[[nodiscard]] std::optional<Twist2> turn_on_the_spot(const Twist2& now, double side,
                                                     std::span<const Vec2> echoes, const Settings& settings);

/// The memory from one lap to the next.
struct State {
  double turning_to =
      0.0;  ///< The side to which it turns on the spot as there is no way ahead, +1 or -1; 0: it does not.
};

/// Does one lap of DWA and notes in `state` what the next one needs.
///
/// If no velocity that leads forward is the best, the robot turns on the spot to the side of the best one, as far as a velocity
/// leads forward by `leave_way` [m] at least. It changes the side if there is no room. The objective function alone would
/// turn it to and fro.
/// @return  at rest if there is no room at all: the robot must brake.
[[nodiscard]] Twist2 steer(const Twist2& now, const Scene& scene, double leave_way, const Settings& settings,
                           State& state);

}  // namespace orca::dwa
