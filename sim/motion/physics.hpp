// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/robot_model.hpp"
#include "orca/sim/world_model.hpp"
#include "sensors/bumper_model.hpp"

namespace orca::sim::detail {

// The kinds of things that a robot can touch: a fixed obstacle, another robot, or a mover that comes and
// goes.
enum class Kind { obstacle, robot, mover };

// Two things that touch or nearly do: a robot and something else.
struct Pair {
  std::size_t robot = 0;
  Kind kind = Kind::obstacle;  // Kind of the other.
  std::size_t other = 0;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

// The relative pose of two things.
struct Standing {
  Vec2 apart;  // [m] The robot's position minus the other's, in the world's axes.
  double robot_yaw = 0.0, other_yaw = 0.0;  // [rad]
};

// The rigid bodies of a world, simulated by Bullet and kept in the plane. Robots are driven by setting their
// velocity before each step; collisions take part of it away. Each run needs a new object, because Bullet's
// caches survive a reset in place.
class Physics {
 public:
  explicit Physics(const WorldModel& world);
  ~Physics();
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;

  std::size_t add_robot(const RobotModel& model, const Pose2& X_WB);

  // Adds a thing that robots cannot push. `shape` is in its own frame, whose pose is `X_WO`.
  // @return  its number; numbers are not used again.
  std::size_t add_mover(const Shape& shape, double height, const Pose2& X_WO);
  // Puts the mover at a pose at once.
  void place_mover(std::size_t mover, const Pose2& X_WO);
  // Moves the mover to a pose in the next step, so that it pushes the robots in its way.
  void carry_mover(std::size_t mover, const Pose2& X_WO);
  void remove_mover(std::size_t mover);

  void set_velocity(std::size_t robot, Vec2 linear, double turn);
  void step(double seconds);
  [[nodiscard]] Pose2 pose(std::size_t robot) const;

  // Returns the distances of all near pairs [m], negative if they overlap. Their order does not depend on
  // Bullet's.
  [[nodiscard]] std::map<Pair, double> near_pairs() const;

  [[nodiscard]] Standing standing(const Pair& pair) const;

  // Returns the places where the robot touches or nearly touches something, in its base frame.
  [[nodiscard]] std::vector<Touch> touches(std::size_t robot) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace orca::sim::detail
