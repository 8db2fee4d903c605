// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/realism.hpp"
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

// What the wheels of a robot want in a step.
struct Drift {
  Vec2 velocity;         // [m/s] In the world's axes.
  double turn = 0.0;     // [rad/s] Of the body.
  double heading = 0.0;  // [rad] Direction in which the wheels roll.
  double grip = 1.0;     // Share of the grip that they have on a dry floor.
};

// The motion of the bodies of a world, in the plane. A robot that touches nothing moves as its wheels want. When
// bodies touch, at the exact outlines that they have at each other's heights, Bullet's solver finds how
// they go on (ContactSolver). A step is cut where the next touch begins, so nothing passes through anything, however fast.
class Physics {
 public:
  // The distance [m] at which a touch counts. Bodies that are pushed together stay a fraction of it apart.
  static constexpr double kTouching = 5e-5;
  // The distance [m] up to which near_pairs() knows of pairs.
  static constexpr double kNear = 0.012;

  // @param errors  of which friction, grip and motors count.
  explicit Physics(const WorldModel& world, const ErrorLevels& errors = {});
  ~Physics();
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;

  std::size_t add_robot(const RobotModel& model, const Pose2& X_WB);

  // Adds a thing that robots cannot push. `shape` is in its own frame, whose pose is `X_WO`.
  // @return  its number; numbers are not used again.
  std::size_t add_mover(const Shape& shape, double height, const Pose2& X_WO);
  // Puts the mover at a pose at once.
  void place_mover(std::size_t mover, const Pose2& X_WO);
  // Moves the mover to a pose in the next step, so that it pushes the robots in its way. It stops where a robot
  // cannot give way.
  void carry_mover(std::size_t mover, const Pose2& X_WO);
  void remove_mover(std::size_t mover);
  [[nodiscard]] Pose2 mover_pose(std::size_t mover) const;
  // Returns the share of the last step in which the mover moved, 0 to 1.
  [[nodiscard]] double mover_progress(std::size_t mover) const;

  void drive(std::size_t robot, const Drift& drift);
  // Puts the robot at a pose at once.
  void place_robot(std::size_t robot, const Pose2& X_WB);
  void step(double seconds);
  [[nodiscard]] Pose2 pose(std::size_t robot) const;

  // Returns the distances of all pairs that are nearer than kNear [m], negative if they overlap.
  [[nodiscard]] const std::map<Pair, double>& near_pairs() const;

  // Returns the distance from the robot to the nearest thing that it could touch [m], at most `limit`; negative if they overlap.
  // @pre  no step is under way.
  [[nodiscard]] double clearance(std::size_t robot, double limit) const;

  // Returns the places where the robot touches or nearly touches something, in its base frame.
  [[nodiscard]] const std::vector<Touch>& touches(std::size_t robot) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The touches that last, so that each is reported once, when it begins. A touch ends only when the two are
// well apart, because a robot that pushes against a wall comes off and on.
class ContactLog {
 public:
  // Returns the pairs that began to touch in this tick.
  std::vector<Pair> update(const Physics& physics) {
    const std::map<Pair, double>& near = physics.near_pairs();
    std::erase_if(touching_, [&](const Pair& pair) {
      const auto now = near.find(pair);
      return now == near.end() || now->second > kApart;
    });
    std::vector<Pair> begun;
    for (const auto& [pair, distance] : near)
      if (distance <= Physics::kTouching && touching_.insert(pair).second) begun.push_back(pair);
    return begun;
  }

  [[nodiscard]] bool touches(std::size_t robot) const {
    return std::ranges::any_of(touching_, [&](const Pair& pair) { return pair.robot == robot; });
  }

 private:
  static constexpr double kApart = 0.01;  // [m]

  std::set<Pair> touching_;
};

}  // namespace orca::sim::detail
