// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/realism.hpp"

namespace orca::sim {

ErrorLevels error_levels(Realism realism) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  switch (realism) {
    case Realism::ideal: return {};
    case Realism::nominal:
      return {.wheel_mismatch = 0.005,
              .track_error = 0.01,
              .slip = 0.003,
              .turn_slip = 0.003,
              .delay_scale = 1.0,
              .sonar_noise = 0.01,
              .sonar_outliers = 0.01,
              .critical_angle = 25.0 * kDegree,
              .sonar_crosstalk = true,
              .laser_bias = 0.01,
              .laser_sigma = 0.005,
              .laser_drop_angle = 80.0 * kDegree,
              .mixed_pixels = true,
              .infrared_noise = 0.05,
              .quantised = true};
    case Realism::harsh:
      return {.wheel_mismatch = 0.01,
              .track_error = 0.02,
              .slip = 0.01,
              .turn_slip = 0.01,
              .delay_scale = 1.5,
              .sonar_noise = 0.02,
              .sonar_outliers = 0.05,
              .critical_angle = 20.0 * kDegree,
              .sonar_crosstalk = true,
              .laser_bias = 0.02,
              .laser_sigma = 0.01,
              .laser_drop_angle = 75.0 * kDegree,
              .mixed_pixels = true,
              .infrared_noise = 0.1,
              .quantised = true};
  }
  return {};
}

}  // namespace orca::sim
