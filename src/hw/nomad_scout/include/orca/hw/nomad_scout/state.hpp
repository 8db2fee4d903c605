// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/nomad_scout/base.hpp"
#include "orca/hw/nomad_scout/packet.hpp"

namespace orca::hw::nomad_scout {

/// Counts after which a coordinate begins anew, if it does: whether a Scout's wrap or stay at the end of 16 bits is not documented.
inline constexpr int kCoordinates = 65536;

/// Coordinates as the robot counts them: they do not reach further than 83 m, so only their differences count.
struct RawPosition {
  int x = 0;  ///< [kLengthUnit]
  int y = 0;  ///< [kLengthUnit]
  friend bool operator==(const RawPosition&, const RawPosition&) = default;
};

using SonarRanges = std::array<double, kSonars>;  ///< [m] by number; infinite: no echo.

/// The answer to each command, as far as a driver needs it.
///
/// A plain value in SI units.
struct State {
  SonarRanges sonars{};
  std::uint32_t bumpers = 0;  ///< A bit per switch; which switch has which bit is not documented.
  RawPosition position{};
  double heading = 0.0;        ///< [rad] in the frame of the odometry, positive to the left, in (-pi, pi].
  Wheels speeds{};             ///< [m/s]
  Duration controller_time{};  ///< Clock of the controller, in ms; it wraps after 49 days.
  double motor_voltage = 0.0;  ///< [V] of the battery for the motors.
};

/// Returns whether the answer to a command of that type is the state.
[[nodiscard]] bool is_answered_by_state(Type command);

/// Reads the state.
/// @errors  invalid_argument if the message is no state; unavailable for a nak; data_loss if it is not as long as a Scout's.
[[nodiscard]] Result<State> parse_state(const Message& message);

}  // namespace orca::hw::nomad_scout
