// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>
#include <string_view>

namespace orca::sim {

/// How unkind the simulated devices are. Every comparison says which level it used.
enum class Realism {
  ideal,    ///< Exact sensors and odometry, a drive without lag and dead time.
  nominal,  ///< As measured on such devices.
  harsh,    ///< About twice as bad.
};

[[nodiscard]] std::string_view to_string(Realism realism);
/// "ideal", "nominal" or "harsh"; nothing for any other word.
[[nodiscard]] std::optional<Realism> realism_from(std::string_view word);

/// The numbers behind a level. docs/simulation.md gives the source of each.
struct ErrorLevels {
  double wheel_mismatch = 0.0;  ///< Bound of the relative error of each wheel's diameter.
  double track_error = 0.0;     ///< Bound of the relative error of the track.
  double slip = 0.0;         ///< [m] Deviation of a wheel's measured travel after 1 m; grows with its root.
  double delay_scale = 0.0;  ///< Times the drive's lag and dead time.
  double sonar_noise = 0.0;  ///< Deviation of a range, relative.
  double sonar_outliers = 0.0;  ///< Probability that a reading is arbitrary.
  double critical_angle =
      0.5 * std::numbers::pi;  ///< [rad] A smooth surface hit at more than this gives no echo.
  bool quantised = false;      ///< Readings come in the device's steps.
};

[[nodiscard]] ErrorLevels error_levels(Realism realism);

}  // namespace orca::sim
