// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Guesses of how wrong the devices of a robot are, as its maker or its user states them. They are what a driver knows;
/// a guess of zeros means "not known". docs/robot-files.md says how a robot's file states them.
#pragma once

#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca {

/// A guess of the errors of odometry that counts the turns of wheels, as standard deviations. The first two are
/// constant during a run. The errors of different wheels are independent of each other.
struct WheelErrorGuess {
  double diameter = 0.0;   ///< [1] relative error of the diameter of each wheel
  double track = 0.0;      ///< [1] relative error of the distance between the wheels
  double slip = 0.0;       ///< [m] error of a wheel's travel after 1 m; it grows with the root of the travel
  double turn_slip = 0.0;  ///< [m] the same after the base has turned 1 rad, in addition

  [[nodiscard]] bool is_known() const {
    return diameter > 0.0 || track > 0.0 || slip > 0.0 || turn_slip > 0.0;
  }
  friend bool operator==(const WheelErrorGuess&, const WheelErrorGuess&) = default;
};

/// A guess of the errors of a range sensor, as standard deviations. The two parts are independent of each other.
struct RangeErrorGuess {
  double fixed = 0.0;  ///< [m] of any range
  double share = 0.0;  ///< [1] of the range

  [[nodiscard]] bool is_known() const { return fixed > 0.0 || share > 0.0; }
  /// Returns the standard deviation of a reading of `range` [m].
  [[nodiscard]] double deviation(double range) const { return portable::hypot(fixed, share * range); }
  friend bool operator==(const RangeErrorGuess&, const RangeErrorGuess&) = default;
};

}  // namespace orca
