// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/vec2.hpp"

namespace orca::sim {

/// A person as an upright cylinder that walks along a track of straight legs for ever.
///
/// Its place depends only on the time and the seed, unless it stops for robots. It pushes robots that are in
/// its way.
struct Walker {
  std::string name;           ///< Name that contacts report.
  std::vector<Vec2> track{};  ///< Corners, at least two.
  double radius = 0.25;       ///< [m]
  double height = 1.7;        ///< [m]
  double speed = 1.0;         ///< [m/s]
  bool round = false;  ///< True: straight from the last corner to the first; false: back along the track.
  Duration pause{0};   ///< Longest rest at a corner; each rest is drawn between 0 and this.
  std::optional<Duration> start{};      ///< Time on its round at time 0; drawn if not given.
  std::optional<std::uint64_t> seed{};  ///< Seed of the drawn values; the run's seed if not given.
  /// [m] It stands still while a robot is nearer than this ahead of it; 0: it stops for no robot.
  double stops = 0.0;
};

}  // namespace orca::sim
