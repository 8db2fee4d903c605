// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "orca/geometry/twist2.hpp"

namespace orca::hw::create2 {

/// Encoder counts of a wheel's turn. This and the diameter are the figures in wide use, but not in every edition of the
/// specification: calibrate a robot by a measured way.
inline constexpr double kCountsPerTurn = 508.8;
inline constexpr double kWheelDiameter = 0.072;  ///< [m]

/// Returns the step from one encoder count to the next, in [-32768, 32767]. Counts have 16 bits and wrap.
[[nodiscard]] int step_of(std::uint16_t previous, std::uint16_t next);

/// Returns the way of a wheel [m] in so many counts.
[[nodiscard]] double wheel_way(int counts);

/// The way of a robot, out of its encoder counts. These wrap after 14.5 m, so only their differences count, and two
/// readings must be less than 7 m apart.
///
/// The encoders cannot sense the direction: the robot takes it from the commands of its motors. So counts are wrong if
/// it is pushed, or coasts while it changes direction (from reports of users alone).
///
/// Thread contract: not synchronised.
class EncoderOdometry {
 public:
  /// Returns how far the robot has come since the last call; nothing at all after the first one.
  Travel2 add(std::uint16_t left, std::uint16_t right);

  /// Makes the next counts a new reference: after the robot was reset, or was not heard for long.
  void forget() { previous_.reset(); }

 private:
  struct Counts {
    std::uint16_t left = 0;
    std::uint16_t right = 0;
  };
  std::optional<Counts> previous_;
};

}  // namespace orca::hw::create2
