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
  Pose2 X_RS;                      ///< The sensor's, robot frame.
};

/// The detail in which a scan is kept. A plain value.
struct Detail {
  double sector = 0.0;  ///< [rad] Of the beams in each sector only the nearest reading is kept,
  double range = 0.0;   ///< [m] and only if it is nearer to the robot's centre than this.
  double near = 0.0;    ///< [m] Of a sector with a reading nearer than this more is kept: the nearest of
  double fine = 0.0;    ///< [rad] each such part.
};

/// Replaces the echoes that the same sensor (`keep.sensor`) has left in the scan's field of view by those in the scan, which
/// misses nothing there. With `keep.hidden` it replaces only those that its beams reach.
///
/// A scan of many beams costs no more than a ring of sonars where nothing is near.
void see(const Scan& scan, const Detail& detail, const EchoMemory::Limits& keep, EchoMemory& memory);

}  // namespace orca::avoid
