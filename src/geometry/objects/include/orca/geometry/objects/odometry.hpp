// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/result.hpp"
#include "orca/idl/geometry.hpp"

namespace orca {

/// A base with two driven wheels on one axle. Frame B lies in the middle between them.
struct DifferentialBase {
  double track = 0.0;        ///< [m] between the points where the wheels touch the ground, > 0
  double left_noise = 0.0;   ///< [m2/m] variance of the left wheel's travel per metre that it rolls, >= 0
  double right_noise = 0.0;  ///< [m2/m] the same for the right wheel
};

/// The distance that the wheels rolled between two readings.
struct WheelTravel {
  double left = 0.0;     ///< [m] forward positive
  double right = 0.0;    ///< [m] forward positive
  idl::TimeValue stamp;  ///< of the second reading
};

/// Integrates wheel travel to a pose, with its uncertainty. The wheels roll at a constant ratio between two
/// readings, so the base drives along an arc of a circle (along_arc()). The wheels' errors are independent of
/// each other and of the pose, with variances that grow with the distance rolled.
///
/// @param X_WB  pose of body B in world W at the previous reading.
/// @return X_WB at the new reading, with its stamp; covariance to first order.
/// @errors  invalid_argument if the track is not positive, a noise is negative, or any of them or the travel
///          is not finite.
/// @thread  pure function; any thread.
/// @source  Siegwart and Nourbakhsh, "Introduction to Autonomous Mobile Robots", MIT Press 2004, 5.2.4, for
/// the
///          error model. They approximate the arc by its chord; here the arc is exact (docs/geometry.md).
[[nodiscard]] Result<idl::Pose2D> integrate_arc(const idl::Pose2D& X_WB, const WheelTravel& travel,
                                                const DifferentialBase& base);

}  // namespace orca
