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
      0.5 * std::numbers::pi;    ///< [rad] A smooth surface hit at more than this gives no echo.
  bool sonar_crosstalk = false;  ///< Transducers hear what others have sent.
  double laser_bias = 0.0;       ///< [m] Bound of the error that all ranges of a laser share in a run.
  double laser_sigma = 0.0;      ///< [m] Deviation of a range.
  double laser_drop_angle =
      0.5 * std::numbers::pi;   ///< [rad] A surface hit at more than this returns nothing.
  bool mixed_pixels = false;    ///< A spot on two surfaces reads as something in between.
  double infrared_noise = 0.0;  ///< [1/m] Deviation of an infrared range per square of the range.
  bool quantised = false;       ///< Readings come in the device's steps.
};

[[nodiscard]] ErrorLevels error_levels(Realism realism);

}  // namespace orca::sim
