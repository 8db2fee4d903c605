// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/geometry/vec2.hpp"

namespace orca::tracking {

/// The estimate of where a person is and how he goes, in a frame that stands still: a Kalman filter of constant velocity, the same for both axes,
/// with people's acceleration as white noise. A plain value.
///
/// @source  Bar-Shalom, Li and Kirubarajan, "Estimation with Applications to Tracking and Navigation", 2001, ch. 6.2 (continuous white noise acceleration).
struct WalkEstimate {
  Vec2 place;                      ///< [m]
  Vec2 velocity;                   ///< [m/s]
  double variance = 0.0;           ///< [m2] of the place in each direction.
  double covariance = 0.0;         ///< [m2/s] of place and velocity.
  double velocity_variance = 0.0;  ///< [m2/s2]

  /// Returns the estimate of somebody who is seen for the first time.
  /// @param error [m]  standard deviation of the place in each direction.
  [[nodiscard]] static WalkEstimate at(Vec2 place, double error);
  /// Goes on by a time [s].
  void predict(double elapsed);
  /// Takes a place where he was seen now. @param error [m]  as above.
  void correct(Vec2 seen, double error);

  [[nodiscard]] double place_error() const;     ///< [m] Standard deviation in each direction.
  [[nodiscard]] double velocity_error() const;  ///< [m/s] The same of the velocity.
};

}  // namespace orca::tracking
