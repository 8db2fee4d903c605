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

// What a robot can touch: what stands for ever, another robot, what comes and goes.
enum class Kind { obstacle, robot, mover };

// Two things that touch or nearly do: a robot and something else.
struct Pair {
  std::size_t robot = 0;
  Kind kind = Kind::obstacle;  // Of the other.
  std::size_t other = 0;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

// How two things stand to each other.
struct Standing {
  Vec2 apart;                               // Of the robot from the other; axes as the world's.
  double robot_yaw = 0.0, other_yaw = 0.0;  // [rad]
};

// Bullet's rigid bodies, kept in the plane. Robots are driven by setting their velocity before each step;
// what they run into takes part of it away. A fresh object for each run: Bullet's caches survive a reset in
// place.
class Physics {
 public:
  explicit Physics(const WorldModel& world);
  ~Physics();
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;

  std::size_t add_robot(const RobotModel& model, const Pose2& X_WB);

  // Something that robots do not push: `shape` in a frame of its own that stands at `X_WO`.
  // @return  its number; numbers are not used again.
  std::size_t add_mover(const Shape& shape, double height, const Pose2& X_WO);
  // Takes it there at once.
  void place_mover(std::size_t mover, const Pose2& X_WO);
  // Has it go there in the next step, and push what is in the way.
  void carry_mover(std::size_t mover, const Pose2& X_WO);
  void remove_mover(std::size_t mover);

  void set_velocity(std::size_t robot, Vec2 linear, double turn);
  void step(double seconds);
  [[nodiscard]] Pose2 pose(std::size_t robot) const;

  // The distance of all near pairs [m], negative when they overlap; ordered, whatever order Bullet keeps.
  [[nodiscard]] std::map<Pair, double> near_pairs() const;

  [[nodiscard]] Standing standing(const Pair& pair) const;

  // Where the robot touches or nearly touches something, in its own frame.
  [[nodiscard]] std::vector<Touch> touches(std::size_t robot) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace orca::sim::detail
