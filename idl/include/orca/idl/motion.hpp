// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// MotionCommand, short ways to make one, HolonomicVelocity, TurretCommand, GripperCommand and FusionReason.
/// idl/orca/motion.idl gives the meaning, unit and frame of each field.
#pragma once

#include "orca/base/result.hpp"
#include "orca/idl/generated/motion.h"
#include "orca/idl/generated/motion.types.hpp"
#include "orca/idl/object.hpp"

namespace orca {

/// Returns the command to stop at once, whatever other behaviours ask for.
[[nodiscard]] Loan<idl::MotionCommand> full_stop();

/// Returns a command without an opinion, which the fuser ignores.
[[nodiscard]] Loan<idl::MotionCommand> dont_care();

/// Returns the command to drive in a direction.
/// @param direction_rad [rad]  robot frame, 0 ahead, positive to the left.
/// @param speed [m/s]  forward positive.
/// @param weight [1]  share when fused with the commands of others, at least 0.
[[nodiscard]] Loan<idl::MotionCommand> head(double direction_rad, double speed, double weight = 1.0);

/// Returns the command to drive and turn.
/// @param rate [rad/s]  positive to the left.
/// @param speed [m/s]  forward positive.
/// @param weight [1]  share when fused with the commands of others, at least 0.
[[nodiscard]] Loan<idl::MotionCommand> turn(double rate, double speed, double weight = 1.0);

/// Returns the command to move in any direction and turn, for a base that can move sideways.
/// @param speed [m/s]  forward positive.   @param left [m/s]  positive to the left.
/// @param rate [rad/s]  positive to the left.
/// @param weight [1]  share when fused with the commands of others, at least 0.
[[nodiscard]] Loan<idl::HolonomicVelocity> slide(double speed, double left, double rate, double weight = 1.0);

/// Returns the sideways speed [m/s] of a command, positive to the left: 0 unless it is a HolonomicVelocity.
[[nodiscard]] double sideways_speed(const ObjectPtr<idl::MotionCommand>& command);

/// Checks the numbers of a command, the same way for all who take commands. Whether a base can carry it out is
/// another question (hw::MotionHW).
/// @errors  invalid_argument for a number that is not finite and for a negative weight. A full stop is never refused,
///          whatever its numbers are.
/// @thread  pure function, as the next ones; any thread.
[[nodiscard]] Status check_command(const idl::MotionCommand& command);
/// @errors  those of a MotionCommand, and invalid_argument for a sideways speed that is not finite.
[[nodiscard]] Status check_command(const idl::HolonomicVelocity& velocity);
/// Checks a command as what it is.
[[nodiscard]] Status check_command(const ObjectPtr<idl::MotionCommand>& command);
/// @errors  invalid_argument for an angle that is not finite.
[[nodiscard]] Status check_command(const idl::TurretCommand& turret);
/// @errors  invalid_argument for a motion that there is not, as damaged data may hold.
[[nodiscard]] Status check_command(const idl::GripperCommand& gripper);

}  // namespace orca
