// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::emulators {

/// The two axes of a Pioneer's controller, translation and rotation. Each has a command of its own, which stays in force until the
/// next one for the same axis: a velocity, or a distance or heading at which the axis stops.
///
/// Thread contract: not synchronised.
/// @source  Pioneer 2 operations manual, "Robot in motion".
class P2osServo {
 public:
  /// Sets the speed [m/s] of move() and the turn rate [rad/s] of turn_to().
  void set_speed(double speed) { move_speed_ = speed; }
  void set_turn_rate(double turn_rate) { heading_rate_ = turn_rate; }

  /// Translates with a speed [m/s].
  void drive(double speed);
  /// Translates by a distance [m], backward if it is negative.
  void move(double distance, const Pose2& from);
  /// Rotates with a turn rate [rad/s].
  void turn(double turn_rate);
  /// Rotates to a heading [rad].
  void turn_to(double heading);
  /// Stops both axes.
  void stop();
  /// Returns whether an axis is on its way to a goal, so that its velocity changes by itself.
  [[nodiscard]] bool has_goal() const { return way_ || heading_; }

  /// Returns the velocity that both axes ask for at this pose. An axis that has reached its goal asks for 0.
  [[nodiscard]] Twist2 velocity(const Pose2& pose);

 private:
  struct Way {
    Pose2 last;   // pose at the last look
    double left;  // [m]
  };

  double move_speed_ = 0.4;
  double heading_rate_ = 1.0;
  Twist2 velocity_{};  // of axes that have no goal
  std::optional<Way> way_;
  std::optional<double> heading_;
};

}  // namespace orca::emulators
