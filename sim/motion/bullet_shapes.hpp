// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/robot_model.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::detail {

// A Bullet shape together with what Bullet only points at.
struct OwnedShape {
  std::unique_ptr<btTriangleMesh> mesh;
  std::vector<std::unique_ptr<btCollisionShape>> children;
  std::unique_ptr<btCollisionShape> shape;
};

// An obstacle as a shape that stands on the floor; `X` becomes its place in the world.
[[nodiscard]] OwnedShape obstacle_shape(const Obstacle& obstacle, btTransform& X);

// A robot's parts as one compound, in the base frame.
[[nodiscard]] OwnedShape robot_shape(const RobotModel& model);

[[nodiscard]] btTransform upright(const Pose2& pose, double z);

}  // namespace orca::sim::detail
