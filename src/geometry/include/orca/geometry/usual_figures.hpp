// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Figures that are taken of a robot whose file does not say them: those of the robots in sim/robots with two wheels.
/// docs/robot-files.md has the table of all defaults.
#pragma once

#include <cstdio>
#include <string>

#include "orca/geometry/error_guess.hpp"

namespace orca {

inline constexpr double kUsualSteerGain = 2.0;  ///< [1/s] turn rate per radian of direction asked for.
/// In general, and at nominal realism.
inline constexpr WheelErrorGuess kUsualWheelErrors{
    .diameter = 0.00204, .track = 0.0058, .slip = 0.003, .turn_slip = 0.003};
/// At harsh realism.
inline constexpr WheelErrorGuess kUsualHarshWheelErrors{
    .diameter = 0.00408, .track = 0.0115, .slip = 0.01, .turn_slip = 0.01};

/// Returns what is missing in a robot's file and what is taken instead, for people; empty if nothing is missing.
inline std::string usual_figures_text(bool lacks_steer_gain, bool lacks_wheel_errors) {
  if (!lacks_steer_gain && !lacks_wheel_errors) return {};
  char gain[64];
  std::snprintf(gain, sizeof gain, "steer_gain=\"%g\"", kUsualSteerGain);
  char errors[160];
  std::snprintf(errors, sizeof errors,
                "<wheel_errors wheel_diameter=\"%g %%\" track=\"%g %%\" slip=\"%g mm\" turn_slip=\"%g mm\"/>",
                100.0 * kUsualWheelErrors.diameter, 100.0 * kUsualWheelErrors.track,
                1000.0 * kUsualWheelErrors.slip, 1000.0 * kUsualWheelErrors.turn_slip);
  const std::string both = lacks_steer_gain && lacks_wheel_errors ? " and " : "";
  return "the file says no " + (lacks_steer_gain ? std::string("steer_gain") : "") + both +
         (lacks_wheel_errors ? "wheel_errors" : "") + " of this robot; the usual ones are taken: " +
         (lacks_steer_gain ? std::string("<drive ... ") + gain + ">" : "") + both +
         (lacks_wheel_errors ? std::string("in <odometry> ") + errors : "") +
         "; write down what you know or have measured";
}

}  // namespace orca
