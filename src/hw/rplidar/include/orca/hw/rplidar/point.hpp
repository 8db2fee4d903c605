// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>

#include "orca/geometry/angle.hpp"

namespace orca::hw::rplidar {

/// A measured point in the frame of the scanner: origin in the axis of rotation, x forward as the manual draws it, where
/// the scanner's angle is 0, y left, z up.
///
/// The scanner turns clockwise seen from above, so the angles of a scan decrease. A plain value.
struct Point {
  bool begins_scan = false;               ///< It is the first of a turn.
  double angle = 0.0;                     ///< [rad] in (-pi, pi], counter-clockwise.
  std::optional<double> range{};          ///< [m] nothing: no echo.
  std::optional<std::uint8_t> quality{};  ///< 0 to 63, strength of the echo; nothing in an express scan.
  friend bool operator==(const Point&, const Point&) = default;
};

/// Returns the angle of a Point.
/// @param degrees [deg]  clockwise, as the scanner counts.
[[nodiscard]] inline double counter_clockwise(double degrees) {
  return wrapped(-degrees * std::numbers::pi / 180.0);
}

}  // namespace orca::hw::rplidar
