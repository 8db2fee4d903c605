// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/guesses.hpp"

namespace orca::sim {

/// What a robot file says of a device for its description only; the simulation does not use it.
struct DeviceLabel {
  std::string vendor;
  std::string model;
  std::string port;  ///< The connection of the real device, e.g. a serial line.
};

/// A scanning laser. Reading k looks along first_angle + k * pitch in the sensor frame; the beam sweeps from
/// the first to the last at an even pace.
struct LaserScanner {
  std::string name;
  std::size_t count = 0;  ///< Number of ranges in a scan.
  /// [rad] Direction of reading 0 in the sensor frame, counter-clockwise from its x axis.
  double first_angle = 0.0;
  double pitch = 0.0;       ///< [rad] Angle from one reading to the next, counter-clockwise positive.
  double min_range = 0.0;   ///< [m] Nearer things read as this.
  double max_range = 0.0;   ///< [m] The reading if nothing returns.
  double quantum = 0.0;     ///< [m] Step of the device's readings; 0: none.
  double divergence = 0.0;  ///< [rad] Opening angle of the beam, which gives the width of its spot.
  Duration period{0};       ///< Time from one scan to the next.
  Duration sweep{0};        ///< Time from the first reading of a scan to its last; at most `period`.
  std::string link;         ///< The URDF link at which it is mounted.
  Pose2 center;             ///< Pose of that link in the base frame.
  double height = 0.0;      ///< [m] Height of that link above the floor.
  bool on_turret = false;   ///< Whether that link turns with the turret.
  /// Whether it hangs upside down. The angles above are those of a level frame all the same; its own are their negatives.
  bool upside_down = false;
  DeviceLabel label{};
  Guesses<RangeErrorGuess> errors{};
};

/// A ring of short-range infrared sensors, all of which measure at once. Number k looks along
/// first_angle + k * pitch from the ring's centre and sits `radius` from it in that direction.
struct InfraredRing {
  std::string name;
  std::size_t count = 0;
  /// [rad] Direction of sensor 0 in the base frame, counter-clockwise from ahead.
  double first_angle = 0.0;
  double pitch = 0.0;      ///< [rad] Angle from one sensor to the next, counter-clockwise positive.
  double half_beam = 0.0;  ///< [rad] Half the opening of the beam.
  double min_range = 0.0;  ///< [m] Nearer things read as this.
  double max_range = 0.0;  ///< [m] The reading if nothing is in sight.
  double radius = 0.0;     ///< [m] Distance of the sensors from the centre.
  Duration period{0};      ///< Time from one round to the next.
  std::string link;        ///< The URDF link at the ring's centre.
  Pose2 center;            ///< Pose of that link in the base frame.
  double height = 0.0;     ///< [m] Height of that link above the floor.
  bool on_turret = false;  ///< Whether that link turns with the turret.
  DeviceLabel label{};
  Guesses<RangeErrorGuess> errors{};

  /// Returns the pose of sensor `k` in the base frame; it looks along its x axis.
  [[nodiscard]] Pose2 sensor(std::size_t k) const {
    const double angle = first_angle + static_cast<double>(k) * pitch;
    const auto [cosine, sine] = portable::cos_sin(angle);
    return center * Pose2{radius * cosine, radius * sine, wrapped(angle)};
  }
};

/// A bumper divided into segments. Segment k is centred at the direction first_angle + k * pitch from the
/// base frame's origin and extends half a pitch to either side. A bumper that does not go all around may list the
/// directions of its segments.
struct BumperRing {
  std::string name;
  std::size_t count = 0;
  /// [rad] Direction of segment 0 in the base frame, counter-clockwise from ahead.
  double first_angle = 0.0;
  double pitch = 0.0;  ///< [rad] Width of a segment, and angle to the next one, counter-clockwise positive.
  std::vector<double> angles;  ///< [rad] Direction of each segment; empty: one after the other, as above.
  double radius = 0.0;         ///< [m] Radius of the bumper, which gives the segments' places.
  Duration period{0};          ///< Time from one reading to the next.
  DeviceLabel label{};

  /// Returns the pose of the middle of segment `k`, x axis outwards, in the base frame.
  [[nodiscard]] Pose2 segment(std::size_t k) const {
    const double angle = angles.empty() ? first_angle + static_cast<double>(k) * pitch : angles[k];
    const auto [cosine, sine] = portable::cos_sin(angle);
    return {radius * cosine, radius * sine, wrapped(angle)};
  }
};

}  // namespace orca::sim
