// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>

namespace orca {

/// Returns the same direction in (-pi, pi].
/// @param angle [rad]  not a number if it is infinite or not a number.
/// @thread  pure function; any thread.
[[nodiscard]] inline double wrapped(double angle) {
  if (angle > -std::numbers::pi && angle <= std::numbers::pi)
    return angle;  // as nearly always; remainder() is dear
  const double r = std::remainder(angle, 2.0 * std::numbers::pi);
  return r <= -std::numbers::pi ? std::numbers::pi : r;
}

}  // namespace orca
