// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <numbers>
#include <span>
#include <string_view>

#include "orca/geometry/pose2.hpp"

namespace orca::hw::p2os {

/// What differs between the robots that speak P2OS. Frames: x forward, y to the left, origin between the wheels.
///
/// A plain value. Its texts and poses live as long as the program.
/// @source  parameter files of the vendor, as AriaCoda (ArRobotTypes.cpp, params/) and other public drivers quote them.
struct Model {
  std::string_view subclass{};  ///< As the robot gives it in answer to SYNC2, in lower case.
  std::string_view name{};      ///< For people.
  double distance_unit = 0.0;   ///< [m] a count of Sip::x and Sip::y.
  double range_unit = 0.0;      ///< [m] a count of a sonar range.
  double half_track = 0.0;      ///< [m] by which a turn rate is multiplied for the speed of a wheel.
  double width = 0.0;           ///< [m] 0: not known.
  double length = 0.0;          ///< [m] 0: not known.
  double behind = 0.0;         ///< [m] by which the middle of the body lies behind the axle, as far as known.
  double radius = 0.0;         ///< [m] of the circle that it turns in; 0: not known.
  double max_speed = 0.0;      ///< [m/s] 0: not known.
  double max_turn_rate = 0.0;  ///< [rad/s] 0: not known.
  std::span<const Pose2>
      sonar_poses{};           ///< Of each in the robot frame, its x axis being the axis of the cone.
  unsigned absent_sonars = 0;  ///< Bit i: number i is counted, but there is no such sonar.
  int front_bumpers = 0;
  int rear_bumpers = 0;
  double velocity_unit = 0.001;                         ///< [m/s] a count of a wheel's speed.
  double angle_unit = 2.0 * std::numbers::pi / 4096.0;  ///< [rad] a count of a heading.
};

/// The model for a subclass.
struct ModelChoice {
  const Model& model;
  bool is_known =
      false;  ///< If not, the model is that of the Pioneer 2-DX: warn, because distances may be wrong.
};

/// Returns the model whose subclass it is; upper and lower case count alike.
[[nodiscard]] ModelChoice choose_model(std::string_view subclass);

/// Returns all models; the first is the default.
[[nodiscard]] std::span<const Model> models();

}  // namespace orca::hw::p2os
