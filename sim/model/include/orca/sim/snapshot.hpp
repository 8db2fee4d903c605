// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim {

/// A robot at one instant, with its trajectory until then if that is kept.
struct RobotSnapshot {
  std::string name;
  Pose2 pose;
  Shape footprint;  ///< Footprint in the world frame, at `pose`.
  struct Sample {
    TimePoint time;
    Pose2 pose;
  };
  /// True poses: the first, one per 5 cm or 0.2 rad, the last. Steps are longer in a run of more than 800 m.
  std::vector<Sample> trajectory;
};

/// A picture of a world at one instant, in world coordinates [m]. A plain value.
struct Snapshot {
  std::string name;
  Bounds bounds;  ///< The rectangle that holds everything except the trajectories.
  std::vector<Segment> edges;
  std::vector<Circle> circles;
  std::vector<Place> places;
  std::vector<RobotSnapshot> robots;
};

/// Returns the snapshot of a world without robots.
[[nodiscard]] Snapshot snapshot_of(const WorldModel& world);

}  // namespace orca::sim
