// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/geometry/objects/odometry_trust.hpp"

#include <algorithm>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/usual_figures.hpp"

namespace orca {
namespace {

constexpr double kTrack = 0.35;  // [m] It matters for slip only.
constexpr double kExact = 0.01;  // [m] deviation of a position, below which it may count as exact

// Whether the position has no variance. A variance of the orientation alone does not say where the robot is.
bool lacks_position(const std::array<double, 9>& covariance) {
  return covariance[0] == 0.0 && covariance[4] == 0.0;
}

}  // namespace

OdometryTrust::OdometryTrust() : guess_(idl::DIFFERENTIAL, kTrack, kUsualWheelErrors) {}

std::array<double, 9> OdometryTrust::covariance_of(const idl::Odometry& odometry) {
  guess_.move_to(plane_pose(odometry));
  const std::array<double, 9> guess = guess_.covariance();
  const bool says_nothing =
      std::ranges::all_of(odometry.covariance(), [](double entry) { return entry == 0.0; });
  guesses_ = says_nothing || (lacks_position(odometry.covariance()) && position_deviation(guess) > kExact);
  return guesses_ ? guess : odometry.covariance();
}

}  // namespace orca
