// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Path tracking by regulated pure pursuit.
/// @source  Coulter, "Implementation of the Pure Pursuit Path Tracking Algorithm", CMU-RI-TR-92-01, 1992, for the arc; Macenski,
///          Singh, Martin and Gines, "Regulated Pure Pursuit for Robot Path Tracking", Autonomous Robots 47, 2023, for a look-ahead that
///          grows with the speed, and speeds regulated by curvature and by nearness of obstacles. Here both regulations are
///          physical: a lateral acceleration, and a speed per clearance of the exact outline.
#pragma once

#include <span>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/footprint.hpp"
#include "orca/navigation/path.hpp"

namespace orca::nav {

/// An arc that begins along the robot's x axis.
struct Arc {
  double curvature = 0.0;  ///< [1/m] positive to the left.
  double length = 0.0;     ///< [m]
};

/// Returns the arc from the robot to a point in its frame. A point behind is reached by more than a quarter of a circle.
/// @pre  the point is not the origin.
/// @thread  pure function, as all of this file; any thread.
[[nodiscard]] Arc arc_to(Vec2 point);

/// Returns the largest speed [m/s] from which a robot comes to rest within `way` [m].
/// @param deceleration [m/s2]  > 0.   @param delay [s]  until it begins to slow down.
[[nodiscard]] double speed_to_stop_within(double way, double deceleration, double delay);

/// [m/s] Speed with which any robot takes any bend.
inline constexpr double kBendSpeed = 0.5;

/// The manner in which a robot follows a path.
struct Pursuit {
  double max_speed = 0.5;             ///< [m/s]
  double turn_rate = 1.0;             ///< [rad/s] largest.
  double look_ahead_time = 0.9;       ///< [s] the look-ahead is the way that the robot drives in it,
  double min_look_ahead = 0.3;        ///< [m] within these bounds.
  double max_look_ahead = 1.5;        ///< [m]
  double lateral_acceleration = 1.0;  ///< [m/s2] largest in a bend.
  double deceleration = 0.5;          ///< [m/s2] with which it can slow down.
  double delay = 0.2;                 ///< [s] from a command to the motion.
  double narrow_speed = 0.4;          ///< [m/s] with nothing free beside the margin.
  double speed_per_clearance = 4.0;   ///< [1/s] what each metre that is free beside it adds to that.
  double turn_in_place = 0.8;         ///< [rad] off the path at which it stops to turn on the spot.
  double turned = 0.2;                ///< [rad] off the path at which it drives on.
  double margin = 0.03;               ///< [m] kept free around the outline.
  double turning_radius = 0.0;  ///< [m] of the smallest circle that it drives; 0: it can turn on the spot.
};

/// Returns how far ahead on its path [m] a robot looks that drives at `speed` [m/s].
[[nodiscard]] double look_ahead(double speed, const Pursuit& pursuit);

/// The motion of the next moment.
struct Steer {
  double speed = 0.0;      ///< [m/s] negative: backwards.
  double turn_rate = 0.0;  ///< [rad/s] positive to the left.
  bool turning = false;    ///< It turns on the spot.
  bool blocked = false;    ///< It can do nothing that follows the path.
};

/// The facts by which the robot steers.
struct Scene {
  Pose2 pose{};                    ///< of the robot when the command takes effect.
  double speed = 0.0;              ///< [m/s] then.
  std::span<const Vec2> points{};  ///< of obstacles, in the frame of the pose and the path.
  bool turning = false;            ///< Steer::turning of the moment before.
};

/// Returns how to turn on the spot by an angle [rad]: the slower the less is left. It is blocked if the corners find no room.
[[nodiscard]] Steer turn_on_the_spot(double angle, const Scene& scene, const Footprint& footprint,
                                     const Pursuit& pursuit);

/// Returns how to follow a path. It takes the longest look-ahead whose arc is free for the exact outline, and drives not
/// faster than it can see, stop, and steer there. If the path begins aside or behind it turns on the spot, if its corners
/// find room.
/// @param along [m]  place of the robot on the path.
/// @param last_speed [m/s]  at the end of the path; 0: it stops there.
[[nodiscard]] Steer follow(const Path& path, double along, const Scene& scene, const Footprint& footprint,
                           const Pursuit& pursuit, double last_speed);

}  // namespace orca::nav
