// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/occupancy_map.hpp"

namespace orca::nav {

/// A scan of a laser that moved while its beam swept.
struct SweptScan {
  std::span<const double> ranges;  ///< [m] one per beam; at or above max_range: no echo.
  double min_range = 0.0;          ///< [m] a smaller range means: too near to be measured.
  double max_range = 0.0;          ///< [m]
  double angle_start = 0.0;        ///< [rad] of the first beam in the sensor frame.
  double angle_increment = 0.0;    ///< [rad]
  Pose2 X_MS_first;                ///< of the sensor in the map at the first beam,
  Pose2 X_MS_last;                 ///< and at the last.
};

/// Computes where the beams of a scan were. An echo beyond `range` [m] counts as none, and nothing is said about what lies beyond.
/// An echo too near to be measured is taken at min_range.
/// @thread  pure function; any thread.
void beams_of(const SweptScan& scan, double range, std::vector<Beam>& beams);

}  // namespace orca::nav
