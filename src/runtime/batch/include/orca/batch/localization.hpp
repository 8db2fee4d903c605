// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca {
struct Scene;
}

namespace orca::batch {

/// A word of a localizer on where its robot is. A plain value.
struct PoseClaim {
  enum class Says : std::uint8_t {
    nothing,  ///< It does not know, or the robot is lost.
    several,  ///< The robot is at one of several places.
    place     ///< It is here.
  };
  std::string robot{};  ///< Empty: the only one.
  TimePoint stamp{};    ///< When the robot is there, by the run's clock.
  Says says = Says::nothing;
  Pose2 X_WR{};  ///< The place, in the world frame; read only if it says `place`.
};

/// The worth of the localizers of a run. Unknown shares are missing. A plain value.
struct LocalizationShares {
  /// Share of the kidnappings after which the localizer claimed no wrong place any more, within 3 s or 1 m of way. Missing if no robot
  /// was carried off.
  std::optional<double> noticed{};
  /// Share of them after which it claimed the right place, to 0.1 m and 5 degrees, within 15 s or 8 m of way.
  std::optional<double> found_again{};
  /// Share of the time in which it claimed a place that is more than 0.5 m off. The 3 s after each kidnapping do not count.
  std::optional<double> sure_but_wrong{};
  /// Share of the time in which it said that there are several places.
  std::optional<double> ambiguous{};
  friend bool operator==(const LocalizationShares&, const LocalizationShares&) = default;
};

/// Judges by the true poses what localizers said. A robot that is more than 1 m from where it was a tenth of a second before was carried off.
///
/// @param claims  in the order of their stamps, evenly spaced.
/// @param scene   of a run that kept the motion of its robots.
/// @thread  no shared state; any thread.
[[nodiscard]] LocalizationShares judge_poses(const std::vector<PoseClaim>& claims, const Scene& scene);

}  // namespace orca::batch
