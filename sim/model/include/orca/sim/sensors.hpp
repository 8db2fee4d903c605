// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::sim {

/// A scanning laser. Reading k looks along first_angle + k * pitch in the sensor frame; the beam sweeps from
/// the first to the last at an even pace.
struct LaserScanner {
  std::string name;
  std::size_t count = 0;     ///< Of readings in a scan.
  double first_angle = 0.0;  ///< [rad] In the sensor frame, counter-clockwise from its x axis.
  double pitch = 0.0;        ///< [rad] Positive: counter-clockwise.
  double min_range = 0.0;    ///< [m] Nearer things read as this.
  double max_range = 0.0;    ///< [m] What no return reads as.
  double quantum = 0.0;      ///< [m] Step of the device's readings; 0: none.
  double divergence = 0.0;   ///< [rad] Opening angle of the beam: how wide its spot is.
  Duration period{0};        ///< From one scan to the next.
  Duration sweep{0};         ///< From the first reading of a scan to its last; at most `period`.
  std::string link;          ///< The URDF link it sits at.
  Pose2 center;              ///< Of that link in the base frame.
  double height = 0.0;       ///< [m] Of that link above the floor.
  bool on_turret = false;    ///< Whether that link turns with the turret.
};

/// A ring of short-range infrared sensors, all of which measure at once. Number k looks along
/// first_angle + k * pitch from the ring's centre and sits `radius` from it in that direction.
struct InfraredRing {
  std::string name;
  std::size_t count = 0;
  double first_angle = 0.0;  ///< [rad] In the base frame, counter-clockwise from ahead.
  double pitch = 0.0;        ///< [rad] Positive: counter-clockwise.
  double half_beam = 0.0;    ///< [rad] Half the opening of the beam.
  double min_range = 0.0;    ///< [m] Nearer things read as this.
  double max_range = 0.0;    ///< [m] What nothing in sight reads as.
  double radius = 0.0;       ///< [m]
  Duration period{0};
  std::string link;        ///< The URDF link at the ring's centre.
  Pose2 center;            ///< Of that link in the base frame.
  double height = 0.0;     ///< [m] Of that link above the floor.
  bool on_turret = false;  ///< Whether that link turns with the turret.

  /// Where sensor `k` sits and looks, in the base frame.
  [[nodiscard]] Pose2 sensor(std::size_t k) const {
    const double angle = first_angle + static_cast<double>(k) * pitch;
    return center * Pose2{radius * std::cos(angle), radius * std::sin(angle), wrapped(angle)};
  }
};

/// A bumper cut in segments. Segment k is around the direction first_angle + k * pitch from the base frame's
/// origin and half a pitch wide to either side.
struct BumperRing {
  std::string name;
  std::size_t count = 0;
  double first_angle = 0.0;  ///< [rad] In the base frame, counter-clockwise from ahead.
  double pitch = 0.0;        ///< [rad] Positive: counter-clockwise.
  double radius = 0.0;       ///< [m] Of the bumper, for who wants to know where a segment is.
  Duration period{0};

  /// The middle of segment `k`, x axis outwards, in the base frame.
  [[nodiscard]] Pose2 segment(std::size_t k) const {
    const double angle = first_angle + static_cast<double>(k) * pitch;
    return {radius * std::cos(angle), radius * std::sin(angle), wrapped(angle)};
  }
};

}  // namespace orca::sim
