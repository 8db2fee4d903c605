// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include "orca/geometry/vec2.hpp"
#include "orca/navigation/footprint.hpp"

/// The artificial potential field as pure functions of any thread.
///
/// Equations are those of O. Khatib, "Real-Time Obstacle Avoidance for Manipulators and Mobile Robots", Int. J. Robotics
/// Research 5(1), 1986, for a point in the plane that has the mass 1. Places are in the robot's frame [m], x forward; forces are
/// accelerations [m/s2].
namespace orca::field {

using nav::Footprint;

/// The shape of the field.
struct Settings {
  double attraction = 0.0;  ///< [1/s2] k_p: of the parabola around the goal.
  double repulsion = 0.0;   ///< [m4/s2] eta: of what is seen.
  double influence =
      0.0;  ///< [m] rho_0: distance of the robot's outline beyond which an obstacle does not repel.
  double damping = 0.0;    ///< [1/s] k_v, above 0: against the velocity.
  double max_speed = 0.0;  ///< [m/s] to which the attraction of a far goal is limited.
  Footprint body;
};

/// Returns the force towards the goal: -k_p (x - x_d), where k_p |x - x_d| is at most k_v max_speed, so that the robot without
/// obstacles does not drive faster than max_speed.
[[nodiscard]] Vec2 attraction(Vec2 goal, const Settings& settings);

/// Returns the force away from an echo, that of FIRAS: eta (1 / rho - 1 / rho_0) / rho^2 from the echo to the point of the
/// outline nearest to it, rho [m] between the two, and nothing from rho_0 on. Nearer than 1 cm, or within the outline, it is as
/// strong as at 1 cm.
[[nodiscard]] Vec2 repulsion(Vec2 echo, const Settings& settings);

/// Returns the sum of the repulsions of all echoes.
[[nodiscard]] Vec2 repulsion(std::span<const Vec2> echoes, const Settings& settings);

/// Returns the velocity [m/s] at which the damping k_v x' balances a force: the robot has no inertia beside the damping.
[[nodiscard]] Vec2 velocity(Vec2 force, const Settings& settings);

/// The part of a velocity that a robot can follow which cannot move sideways or backwards.
struct Course {
  double direction = 0.0;  ///< [rad] of the velocity, robot frame.
  double speed =
      0.0;  ///< [m/s] its part along the robot's axis, at most max_speed; 0 if it points backwards.
};

/// Returns the course that a velocity asks for.
[[nodiscard]] Course course(Vec2 velocity, const Settings& settings);

}  // namespace orca::field
