// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>

#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// From commanded to driven velocity, tick by tick: dead time, speed limits, first-order lag, acceleration
// limits.
class DriveModel {
 public:
  DriveModel(const Drive& drive, const ErrorLevels& errors, Duration tick);

  void command(Velocity wanted);

  // The velocity to drive in the tick that begins now.
  Velocity step();

  // Something stood in the way: the base really moved like this. The next step starts from it.
  void held_to(Velocity real) { velocity_ = real; }

 private:
  [[nodiscard]] double approach(double now, double target, double max_change) const;

  Drive drive_;
  double tick_s_;
  double share_;  // Of the difference to its target that the velocity covers in a tick.
  Velocity velocity_;
  std::deque<Velocity> pending_;  // One per tick of dead time, the oldest first, and the newest command last.
};

}  // namespace orca::sim::detail
