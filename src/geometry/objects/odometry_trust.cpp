// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/geometry/objects/odometry_trust.hpp"

#include <algorithm>

#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/usual_figures.hpp"

namespace orca {
namespace {

constexpr double kTrack = 0.35;  // [m] It matters for slip only.

}  // namespace

OdometryTrust::OdometryTrust() : guess_(idl::DIFFERENTIAL, kTrack, kUsualWheelErrors) {}

std::array<double, 9> OdometryTrust::covariance_of(const idl::Odometry& odometry) {
  guess_.move_to(plane_pose(odometry));
  guesses_ = std::ranges::all_of(odometry.covariance(), [](double entry) { return entry == 0.0; });
  return guesses_ ? guess_.covariance() : odometry.covariance();
}

}  // namespace orca
