// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <numbers>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/robot_file/guesses.hpp"

namespace orca::sim {

using robot_file::Realism;
using robot_file::realism_from;
using robot_file::to_string;

/// The numbers behind a level, and estimates. docs/realism.md gives the source of each.
struct ErrorLevels {
  double wheel_mismatch = 0.0;  ///< Bound of the ratio of two wheels' diameters, less 1.
  double wheel_size = 0.0;      ///< Bound of the relative error of the wheels' mean diameter.
  double track_error = 0.0;     ///< Bound of the relative error of the track.
  /// [m] Standard deviation of a wheel's way over the floor per root of a metre that it rolls, on long ways.
  double slip = 0.0;
  /// [m] The same per root of a radian that the base turns, in addition.
  double turn_slip = 0.0;
  /// [m] Standard deviation of the slip that all wheels of a base have in common, per root of a metre that it drives.
  double common_slip = 0.0;
  double delay_scale = 0.0;     ///< Factor on the drive's lag and dead time.
  double sonar_noise = 0.0;     ///< Relative standard deviation of a range.
  double sonar_outliers = 0.0;  ///< Probability that a reading is arbitrary.
  double sonar_dead = 0.0;      ///< Share of transducers that neither send nor hear; drawn for each robot.
  /// [rad] A smooth surface that is hit at a larger incidence gives no echo.
  double critical_angle = 0.5 * std::numbers::pi;
  bool sonar_crosstalk = false;  ///< Transducers hear each other's chirps.
  double laser_bias = 0.0;       ///< [m] Bound of the error that all ranges of a laser share in a run.
  double laser_sigma = 0.0;      ///< [m] Standard deviation of a range.
  /// [rad] A surface that is hit at a larger incidence returns nothing.
  double laser_drop_angle = 0.5 * std::numbers::pi;
  /// Weakest echo that half of the beams return, as a share of that of a surface of 10 % that is met head on at max_range.
  double laser_threshold = 0.0;
  bool mixed_pixels = false;    ///< A spot on two surfaces reads as something in between.
  double infrared_noise = 0.0;  ///< [1/m] Standard deviation of an infrared range per square of the range.
  bool quantised = false;       ///< Readings come in the device's steps.

  // Own estimates that every level shares.
  /// [m] Way over which a wheel's slip keeps its share of the way: integral of its correlation.
  double slip_length = 0.1;
  double common_length = 1.0;    ///< [m] The same of common_slip.
  double slip_angle = 0.2;       ///< [rad] The same of turn_slip, over the turn of the base.
  double sonar_edges = 0.3;      ///< Strength of an edge's echo, as a share of a wall's.
  double sonar_threshold = 0.1;  ///< Weakest sound that is heard, as a share of that on the axis.
  /// [rad] Walls whose directions differ by less count as one line.
  double sonar_in_line = std::numbers::pi / 180.0;
  double laser_spot = 1.0;  ///< Factor on the opening angle that the robot's file gives the beam.
  /// Coefficient of friction of what touches: painted metal and plastic on a wall.
  double contact_friction = 0.16;
  /// Share of the weight that the wheels hold before they slide: rubber on a dry floor.
  double wheel_grip = 0.7;
  /// Force of the motors, as a multiple of what the acceleration limit takes.
  double motor_force = 2.0;
};

[[nodiscard]] ErrorLevels error_levels(Realism realism);

/// Multiplies single errors of a level, or estimates that all levels share, in order to see how much a result depends on
/// them. An angle grows to 90 degrees at most, a probability or a share to 1.
///
/// @param factors  names of numbers of ErrorLevels with a factor each, from 0 to 100: "slip=2; sonar_noise=0.5". Empty: none.
/// @errors  invalid_argument, with the first word that is wrong and what is expected.
[[nodiscard]] Result<ErrorLevels> scaled(ErrorLevels levels, std::string_view factors);

}  // namespace orca::sim
