// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "bumper_model.hpp"
#include "orca/sim/robot_model.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::detail {

// Two things that touch or nearly do: a robot, and an obstacle or another robot.
struct Pair {
  std::size_t robot = 0;
  bool other_is_robot = false;
  std::size_t other = 0;
  friend auto operator<=>(const Pair&, const Pair&) = default;
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
  void set_velocity(std::size_t robot, Vec2 linear, double turn);
  void step(double seconds);
  [[nodiscard]] Pose2 pose(std::size_t robot) const;

  // The distance of all near pairs [m], negative when they overlap; ordered, whatever order Bullet keeps.
  [[nodiscard]] std::map<Pair, double> near_pairs() const;

  // Where the robot touches or nearly touches something, in its own frame.
  [[nodiscard]] std::vector<Touch> touches(std::size_t robot) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace orca::sim::detail
