// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

namespace orca {

/// Checks whether a reading says anything valid, the same way for all who drive by readings. A reading that does not counts
/// as none: whoever takes it acts as if its sender had fallen silent. SenderWatch says so in the log.
///
/// A single range that is not a number says nothing, and the others still count. An infinite range is one that was measured:
/// nothing was seen, or, if negative, something is too near.
///
/// @errors  invalid_argument, with what was found and what was expected: a scan without beams, without a range that is a
///          number, or whose angles, limits or pose are none that a sensor can have.
/// @thread  pure function, as the next four; any thread.
[[nodiscard]] Status check_reading(const idl::LaserRangeReadings& scan);
/// @errors  invalid_argument, likewise; a range without a pose of its sonar says nothing.
[[nodiscard]] Status check_reading(const idl::SonarRangeReadings& round);
[[nodiscard]] Status check_reading(const idl::InfraredRangeReadings& round);
/// @errors  invalid_argument for a number that is not finite or of no possible size, and for a negative variance.
[[nodiscard]] Status check_reading(const idl::RobotPose& pose);
/// @errors  invalid_argument, likewise.
[[nodiscard]] Status check_reading(const idl::Odometry& odometry);

inline constexpr double kFastest = 10.0;      ///< [m/s] No robot that Orca drives is faster,
inline constexpr double kFastestTurn = 10.0;  ///< [rad/s] or turns faster.

/// Returns a question for the sender of a command that is valid, but an order of magnitude beyond what robots do; nothing if
/// there is none to be asked. The usual reason is a number in degrees or millimetres.
/// @thread  pure function, as the next; any thread.
[[nodiscard]] std::optional<std::string> doubt_about(const idl::MotionCommand& command);
[[nodiscard]] std::optional<std::string> doubt_about(const idl::HolonomicVelocity& velocity);

}  // namespace orca
