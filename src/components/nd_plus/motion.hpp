// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "orca/avoidance/footprint.hpp"
#include "orca/geometry/vec2.hpp"
#include "region.hpp"

/// The six situations of ND+ and their motion laws. Terms, frames and threads: see diagram.hpp.
namespace orca::nd {

using avoid::Footprint;

/// The settings, which do not change from lap to lap.
struct Settings {
  Footprint body;
  double security_distance =
      0.0;  ///< [m] D_s, from the outline, above 0: an obstacle nearer than this is a dangerous one.
  double wide = 0.0;           ///< [rad] a region wider than this is a wide one.
  double max_speed = 0.0;      ///< [m/s]
  double max_turn_rate = 0.0;  ///< [rad/s]
  double least_share = 0.0;    ///< [0, 1] of the speed that is left however near an obstacle is.
  double margin = 0.0;         ///< [m] kept free around the body.
  double reaction = 0.0;       ///< [s] after which the robot begins to brake.
  avoid::Brakes brakes;        ///< Both above 0.
};

/// Returns half the width [m] of the way that a body needs straight ahead.
[[nodiscard]] double half_way(const Footprint& body);

/// The nearest dangerous obstacle on one side of the way.
struct Danger {
  double direction = 0.0;  ///< [rad]
  double share = 0.0;      ///< [0, 1) its distance from the outline by the security distance.
};

/// The dangerous obstacles on both sides, none where safety is high.
struct Dangers {
  std::optional<Danger> left;
  std::optional<Danger> right;

  /// Returns the smaller of their shares; 1 if there are none.
  [[nodiscard]] double share() const;
};

/// Returns the nearest dangerous obstacles to both sides of a direction [rad]. Obstacles behind are none: the robot leaves them.
[[nodiscard]] Dangers dangers(std::span<const Vec2> echoes, double direction, const Settings& settings);

/// The situation of the robot: low or high safety; dangers on one or both sides; goal in the region, a wide or a narrow one.
enum class Situation {
  low_safety_goal_in_region,   ///< LSGR
  low_safety_1_side,           ///< LS1
  low_safety_2_sides,          ///< LS2
  high_safety_goal_in_region,  ///< HSGR
  high_safety_wide_region,     ///< HSWR
  high_safety_narrow_region,   ///< HSNR
};

/// Returns the situation: one of the six leaves of the decision tree.
[[nodiscard]] Situation situation(const Dangers& dangers, const FreeWalkingArea& area, double wide);

/// Returns the direction [rad] of motion, within pi / 2 to both sides:
///
/// * HSGR: to the goal. HSNR: to the middle of the region.
/// * HSWR: past the edge at a distance of the security distance from the body.
/// * LSGR and LS1: as if safety were high, turned away from the danger by the share that it is within the security distance.
/// * LS2: to the place to which the robot goes, turned to the side where there is more room.
/// @param radius [m]  of the circle that found room in the region.
[[nodiscard]] double motion_direction(const Dangers& dangers, const FreeWalkingArea& area, double radius,
                                      const Settings& settings);

/// The motion of the robot.
struct Course {
  double speed = 0.0;      ///< [m/s]
  double turn_rate = 0.0;  ///< [rad/s]
};

/// Returns the speeds for a direction of motion within pi / 2 to both sides. The turn rate grows with the angle, the speed falls
/// with it, and with the share of the security distance that the nearest danger leaves.
[[nodiscard]] Course course(double direction, double share, const Settings& settings);

/// Returns whether the robot can stop before an echo is nearer to its body than the margin.
[[nodiscard]] bool is_safe(const Course& course, std::span<const Vec2> echoes, const Settings& settings);

/// Returns the course that the body can follow safely: slower, if that is not safe, and without so much of its turn, if that
/// does not help. Returns standing if nothing is safe.
///
/// While it drives it keeps so far off what is ahead that its corners can turn there. A body that finds no room to turn goes on straight
/// ahead.
/// @param turn_rate [rad/s]  at which it turns now. Driving has to be safe with it too: a base takes time to follow.
[[nodiscard]] Course made_safe(const Course& wanted, double share, double turn_rate,
                               std::span<const Vec2> echoes, const Settings& settings);

/// Returns the fastest speed [m/s] from which the robot can stop within a way [m].
[[nodiscard]] double speed_to_stop(double way, const Settings& settings);

}  // namespace orca::nd
