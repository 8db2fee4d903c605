// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// MotionCommand, short ways to make one, HolonomicVelocity, TurretCommand and FusionReason. What each field
/// means, its unit and frame, is said in idl/orca/motion.idl.
#pragma once

#include "orca/idl/generated/motion.h"
#include "orca/idl/generated/motion.types.hpp"
#include "orca/idl/object.hpp"

namespace orca {

/// Stop at once, whatever others ask for.
[[nodiscard]] Loan<idl::MotionCommand> full_stop();

/// No opinion: the fuser disregards it.
[[nodiscard]] Loan<idl::MotionCommand> dont_care();

/// Drive in a direction.
/// @param direction_rad [rad]  robot frame, 0 ahead, positive to the left.
/// @param speed [m/s]  forward positive.
/// @param weight [1]  share when fused with the wishes of others, at least 0.
[[nodiscard]] Loan<idl::MotionCommand> head(double direction_rad, double speed, double weight = 1.0);

/// Drive and turn.
/// @param rate [rad/s]  positive to the left.
/// @param speed [m/s]  forward positive.
/// @param weight [1]  share when fused with the wishes of others, at least 0.
[[nodiscard]] Loan<idl::MotionCommand> turn(double rate, double speed, double weight = 1.0);

}  // namespace orca
