// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>

#include "orca/geometry/twist2.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// A command to a base and its turret.
struct BaseCommand {
  Twist2 velocity;
  bool emergency_stop = false;
  double turret_angle = 0.0;  // [rad] Angle in the robot's frame.
};

// The dynamics from commanded to driven velocity, tick by tick: dead time, speed limits, first-order lag and
// acceleration limits. The model is the same for all kinds of base. An emergency stop bypasses the velocity control and
// so its lag; the base slows down evenly.
class DriveModel {
 public:
  DriveModel(const Drive& drive, const ErrorLevels& errors, Duration tick);

  void command(const Twist2& wanted);
  void emergency_stop();
  void point_turret(double angle) { pending_.back().turret_angle = angle; }

  // Returns the velocity to drive in the tick that begins now.
  Twist2 step();
  // Returns the commanded angle [rad] of the turret in that tick, in the robot's frame.
  [[nodiscard]] double turret_angle() const { return target_.turret_angle; }

  // Reports the real velocity of a base that was held by an obstacle. The next step starts from it.
  void held_to(const Twist2& real) { velocity_ = real; }

 private:
  void follow(const Twist2& target, double share, double acceleration_scale);

  Drive drive_;
  double tick_s_;
  double share_;  // Part of the difference to its target that the velocity covers in a tick.
  Twist2 velocity_;
  BaseCommand target_;
  std::deque<BaseCommand> pending_;  // One per tick of dead time, the oldest first, the newest command last.
};

}  // namespace orca::sim::detail
