// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/robot_model.hpp"
#include "rounded.hpp"

namespace orca::sim::detail {

// A body that moves evenly in a step.
struct MovingBody {
  Pose2 pose;
  Vec2 velocity;       // [m/s] In the world's axes.
  double turn = 0.0;   // [rad/s]
  double reach = 0.0;  // [m] Distance of its farthest point from its origin.

  [[nodiscard]] Pose2 at(double seconds) const {
    const Vec2 there = pose.position() + seconds * velocity;
    return {there.x, there.y, wrapped(pose.yaw + seconds * turn)};
  }
  [[nodiscard]] double speed() const { return norm(velocity) + std::fabs(turn) * reach; }
};

// A piece of a body in its frame, with the heights between which it stands.
struct Piece {
  Rounded plan;
  double bottom = 0.0, top = 0.0;  // [m]
};

// What robots touch with: their parts, seen from above between two heights.
class RobotOutline {
 public:
  explicit RobotOutline(std::vector<Part> parts);

  // Returns the plans of the parts that reach into the range, in the base frame. They stay where they are.
  [[nodiscard]] const std::vector<Rounded>& between(double low, double high);
  // Returns the parts as pieces, in the base frame.
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] double reach() const { return reach_; }

 private:
  std::vector<Part> parts_;
  std::vector<Piece> pieces_;
  double reach_ = 0.0;
  std::map<std::pair<double, double>, std::vector<Rounded>> plans_;  // Those that were asked for before.
};

// Returns the distance of the farthest point of a solid from the origin of its frame.
[[nodiscard]] double reach_of(const Rounded& plan);

}  // namespace orca::sim::detail
