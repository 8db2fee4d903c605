// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/base/result.hpp"
#include "orca/hw/player/message.hpp"
#include "orca/hw/player/payload.hpp"
#include "orca/hw/player/sensors.hpp"

namespace orca::hw::player {

// Rangers as the sonars or the laser that they are.

/// Reads the ranges of a ranger, and its configuration if that comes with them.
/// @return nothing if the message has no ranges.
/// @errors  those of decode().
[[nodiscard]] std::optional<Result<RangerStamped>> read_ranges(const Message& message);

[[nodiscard]] SonarRanges as_sonar(const RangerValues& values);

/// Returns where the elements are on the robot: each place is told in the frame of the device.
[[nodiscard]] SonarGeometry as_sonar(const RangerGeometry& geometry);

/// Returns a scan whose beams are evenly spread between the angles; those of a configuration that says nothing come from `otherwise`.
///
/// The angular resolution is not looked at: some servers say the angle over the number of beams.
/// @param otherwise  its min_angle, max_angle and max_range.
[[nodiscard]] LaserScan as_laser(const RangerValues& values, const std::optional<RangerConfig>& config,
                                 const RangerConfig& otherwise);

}  // namespace orca::hw::player
