// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "orca/component/sender_life.hpp"
#include "orca/geometry/objects/odometry_trust.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/map_localizer.hpp"

namespace orca::localizer {

/// The latest odometry, and whether it goes on from the one before.
///
/// Thread contract: the component's strand.
class Reckoning {
 public:
  /// Takes the next odometry.
  /// @return whether it goes on from the one before, if there was one: false if it counts from another place.
  bool take(const idl::Odometry& odometry) {
    const nav::Reckoned now{to_seconds(to_time_point(odometry.stamp()).time_since_epoch()),
                            plane_pose(odometry), trust_.covariance_of(odometry)};
    const bool is_anew = life_.begins_anew(odometry);
    const auto before = std::exchange(latest_, now);
    return !before || (!is_anew && !has_jumped(*before, now));
  }

  /// Returns it; nothing: none has come.
  [[nodiscard]] const std::optional<nav::Reckoned>& latest() const { return latest_; }
  /// Goes on from an odometry that another one has taken.
  void resume(const nav::Reckoned& latest) { latest_ = latest; }
  /// Names the rest of what a successor goes on with.
  [[nodiscard]] auto state() { return std::tie(life_); }

 private:
  // Odometry that has gone on farther than any robot can drive counts from another place.
  static bool has_jumped(const nav::Reckoned& before, const nav::Reckoned& now) {
    constexpr double kFastest = 10.0;  // [m/s]
    constexpr double kRoom = 0.5;      // [m]
    return norm(now.X_OR.position() - before.X_OR.position()) >
           kRoom + kFastest * std::max(0.0, now.time - before.time);
  }

  OdometryTrust trust_;
  SenderLife life_;
  std::optional<nav::Reckoned> latest_;
};

}  // namespace orca::localizer
