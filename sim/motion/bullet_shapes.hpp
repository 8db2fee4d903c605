// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/robot_model.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::detail {

// A Bullet shape together with the objects that Bullet only points at.
struct OwnedShape {
  std::unique_ptr<btTriangleMesh> mesh;
  std::vector<std::unique_ptr<btCollisionShape>> children;
  std::unique_ptr<btCollisionShape> shape;
};

// Returns the collision shape of an obstacle and sets `X` to its pose in the world.
[[nodiscard]] OwnedShape obstacle_shape(const Obstacle& obstacle, btTransform& X);

// Returns a robot's parts as one compound shape in the base frame.
[[nodiscard]] OwnedShape robot_shape(const RobotModel& model);

// Returns the transform of an upright body at a pose in the plane and a height [m].
[[nodiscard]] btTransform upright(const Pose2& pose, double z);

}  // namespace orca::sim::detail
