// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "braking.hpp"
#include "orca/base/result.hpp"
#include "orca/collision/swept_body.hpp"
#include "orca/hw/endpoints.hpp"

namespace orca::gate {

/// The robot as its file describes it: its body in space, what it makes of a command, and how it comes to rest.
///
/// Thread contract: as for a container.
class Machine {
 public:
  /// Reads a robot file. A body that the file does not show, or that does not turn with its wheels, is an upright cylinder.
  /// @errors  invalid_argument with all that is wrong with the file; failed_precondition if the robot has no drive.
  static Result<Machine> read(const std::string& path);

  /// @param holds  whether the gripper holds something.
  [[nodiscard]] const collision::SweptBody& body(bool holds) const { return holds ? loaded_ : empty_; }
  /// Returns the velocity that the base makes of a command.
  [[nodiscard]] Twist2 twist_of(const ObjectPtr<idl::MotionCommand>& command) const {
    const auto velocity = command.as<idl::HolonomicVelocity>();
    return velocity ? hw::twist_of(*velocity, limits_) : hw::twist_of(*command, limits_);
  }
  /// Returns whether the base can move sideways.
  [[nodiscard]] bool slides() const { return limits_.type == idl::HOLONOMIC; }
  /// @param reaction  [s] until the base gets a command; its own delay is added.
  [[nodiscard]] Rules rules(double reaction, double margin) const;

 private:
  Machine(collision::SweptBody empty, collision::SweptBody loaded)
      : empty_(std::move(empty)), loaded_(std::move(loaded)) {}

  collision::SweptBody empty_;
  collision::SweptBody loaded_;
  hw::DriveLimits limits_;
  Brakes gentle_;
  Brakes hard_;
  double delay_ = 0.0;  // [s] of the base
};

}  // namespace orca::gate
