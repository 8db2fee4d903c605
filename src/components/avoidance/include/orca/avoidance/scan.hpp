// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include "orca/avoidance/echo_memory.hpp"

namespace orca::avoid {

/// A planar scan and the sensor pose at which it was taken.
struct Scan {
  std::span<const double> ranges;  ///< [m] one per beam.
  double min_range = 0.0;          ///< [m] a reading below it only means that something is at the sensor.
  double max_range = 0.0;          ///< [m] at or above it nothing was seen.
  double angle_start = 0.0;        ///< [rad] of the first beam, sensor frame.
  double angle_increment = 0.0;    ///< [rad] from one beam to the next.
  Pose2 X_RS;                      ///< Of the sensor, robot frame.
};

/// Replaces the echoes remembered in the scan's field of view by those in the scan, which misses nothing
/// there. With `keep.hidden` it replaces only those that its beams reach.
///
/// Of the beams in each `sector` [rad] only the nearest reading is kept, and only if it is nearer to the
/// robot's centre than `range` [m]. A scan of many beams then costs no more than a ring of sonars.
void see(const Scan& scan, double sector, double range, const EchoMemory::Limits& keep, EchoMemory& memory);

}  // namespace orca::avoid
