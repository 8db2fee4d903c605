// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim {

/// A robot as it is to be drawn.
struct SceneRobot {
  std::string name;
  Pose2 pose;
  Shape footprint;  ///< In the world frame, at `pose`.
  struct Sample {
    TimePoint time;
    Pose2 pose;
  };
  std::vector<Sample> trajectory;  ///< True poses: the first, one per 5 cm or 0.2 rad, the last.
};

/// What a picture of a world shows, in world coordinates [m]. A plain value; the renderer is elsewhere.
struct Scene {
  std::string name;
  Bounds bounds;  ///< Holds everything but the trajectories.
  std::vector<Segment> edges;
  std::vector<Circle> circles;
  std::vector<Place> places;
  std::vector<SceneRobot> robots;
};

/// The static part of a scene.
[[nodiscard]] Scene scene_of(const WorldModel& world);

}  // namespace orca::sim
