// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/hw/endpoints.hpp"
#include "orca/sim/robot_model.hpp"
#include "shared_world.hpp"
#include "stall_watch.hpp"

namespace orca::sim {

/// The reflex of a simulated base: it stands when a bumper is pressed, or when its wheels do not turn although they
/// should, until a command asks for another direction. A base without bumpers stands when it touches anything.
///
/// Thread contract: one strand.
class TouchGuard {
 public:
  /// @param robot, motion  outlive this object.
  TouchGuard(const RobotModel& robot, hw::MotionHW& motion) : robot_(robot), motion_(motion) {}

  /// Stops the base if what it has sensed since the last call says so.
  void look(const SharedWorld::Inbox& inbox);

  /// Notes what the motors were told last.
  void driven(const Twist2& velocity, TimePoint now) { stall_.driven(velocity, now); }

 private:
  [[nodiscard]] std::vector<hw::Obstruction::Pressed> pressed(std::size_t ring,
                                                              const BumperReading& reading) const;

  const RobotModel& robot_;
  hw::MotionHW& motion_;
  StallWatch stall_;
};

}  // namespace orca::sim
