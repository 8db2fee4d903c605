// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>

#include "orca/geometry/objects/odometry.hpp"
#include "orca/idl/sensing.hpp"

namespace orca {

/// The trust in the poses of some odometry, for those who drive by them. Odometry with a covariance is taken at its word.
/// Odometry without one, or without a variance of the position after some metres, is not exact, but unknown: it counts as wrong
/// as is usual (usual_figures.hpp).
///
/// Thread contract: not synchronised; one strand.
class OdometryTrust {
 public:
  OdometryTrust();

  /// Returns the covariance [m2, m rad, rad2] of x, y and steer_angle, row by row.
  /// @pre  called with each reading, in their order.
  [[nodiscard]] std::array<double, 9> covariance_of(const idl::Odometry& odometry);

  /// Returns whether the last reading came without a covariance.
  [[nodiscard]] bool guesses() const { return guesses_; }

 private:
  OdometryUncertainty guess_;
  bool guesses_ = false;
};

}  // namespace orca
