// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "orca/geometry/vec2.hpp"

namespace orca::hw::p2os {

/// Returns the step from one raw coordinate to the next, in [-16384, 16383] counts. Coordinates have 15 bits and wrap;
/// bit 15 is ignored.
[[nodiscard]] int step_of(std::uint16_t previous, std::uint16_t next);

/// The way of a robot, out of the coordinates in its SIPs. These wrap after some metres, so only their differences
/// count.
///
/// Thread contract: not synchronised.
class WheelOdometry {
 public:
  /// @param distance_unit [m]  of Model.
  explicit WheelOdometry(double distance_unit) : distance_unit_(distance_unit) {}

  /// Returns how far the robot has come since the last call [m], in the frame of its odometry; {0, 0} after the first one.
  Vec2 add(std::uint16_t x, std::uint16_t y);

  /// Makes the next coordinates a new reference: after the connection was opened again, or the odometry was set to 0.
  void forget() { previous_.reset(); }

 private:
  struct Counts {
    std::uint16_t x = 0;
    std::uint16_t y = 0;
  };
  double distance_unit_ = 0.0;
  std::optional<Counts> previous_;
};

}  // namespace orca::hw::p2os
