// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Composition and inverse of poses with covariances, to first order. The covariance of a result is J C J^T,
/// where J holds the derivatives of the result with respect to its arguments. This holds while standard
/// deviations of angles are small compared with 1 rad. docs/geometry.md has the equations.
///
/// A covariance of zeros counts as exactly known here. Results are symmetric and, up to rounding, positive
/// semidefinite if the arguments are.
#pragma once

#include <array>

#include "orca/base/result.hpp"
#include "orca/idl/geometry.hpp"

namespace orca {

/// Returns the pose of frame C in A, from the poses of B in A and of C in B, whose errors are independent.
/// @return its stamp is the later one of both.
/// @thread  pure function; any thread.
/// @source  Smith, Self and Cheeseman, "Estimating uncertain spatial relationships in robotics", in
///          Autonomous Robot Vehicles, Springer 1990: compounding.
[[nodiscard]] idl::Pose2D compose(const idl::Pose2D& X_AB, const idl::Pose2D& X_BC);

/// Returns the pose of frame A in B from that of B in A.
/// @thread  pure function; any thread.
/// @source  Smith, Self and Cheeseman 1990: the inverse relationship.
[[nodiscard]] idl::Pose2D inverse(const idl::Pose2D& X_AB);

/// Returns how far the position of a pose in the plane may be off: its standard deviation [m] in the direction in which it
/// is largest.
/// @param covariance [m2, m rad, rad2]  of x, y, orientation, row by row; all zero, which means "not known", gives 0.
/// @thread  pure function; any thread.
[[nodiscard]] double position_deviation(const std::array<double, 9>& covariance);

/// Returns the covariance of a pose that may be anywhere, with which a localizer says that it has lost the robot.
/// @thread  pure function, as the next; any thread.
[[nodiscard]] std::array<double, 9> anywhere();
/// Returns whether a covariance says that: the position is not known to 100 km.
[[nodiscard]] bool is_anywhere(const std::array<double, 9>& covariance);

/// Composes poses in space, as compose() does in the plane.
/// @errors  failed_precondition if the result's x axis points straight up or down (within 1e-6 rad) and its
///          covariance is not zero: roll and yaw cannot be separated there, so theirs does not exist.
/// @thread  pure function; any thread.
[[nodiscard]] Result<idl::Pose3D> compose(const idl::Pose3D& X_AB, const idl::Pose3D& X_BC);

/// Inverts a pose in space, as inverse() does in the plane.
/// @errors  as compose().
/// @thread  pure function; any thread.
[[nodiscard]] Result<idl::Pose3D> inverse(const idl::Pose3D& X_AB);

}  // namespace orca
