// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::detail {

// The area that a round robot can reach from a place, found by a flood fill over a lattice of 5 cm. Each free
// point lies so far from every obstacle that the robot keeps its radius even between two points.
class Reach {
 public:
  static constexpr double kPitch = 0.05;  // [m]
  static constexpr std::size_t kMostPoints = 20'000'000;

  // Returns true if the world is small enough for the lattice.
  [[nodiscard]] static bool fits(const WorldModel& world);

  // @pre  fits(world).
  Reach(const WorldModel& world, Vec2 from, double radius);

  // Returns true if the robot can reach the lattice point nearest to `p`.
  [[nodiscard]] bool reaches(Vec2 p) const;

 private:
  struct Lattice {
    int left, bottom;  // Coordinates of the lowest point, in pitches.
    int columns, rows;
  };
  enum class State : unsigned char { free, blocked, reached };

  [[nodiscard]] static Lattice lattice_of(const WorldModel& world);
  void block(const Obstacle& obstacle, double radius);
  void flood(std::size_t from);
  [[nodiscard]] bool holds(Vec2 p) const;
  [[nodiscard]] std::size_t index(Vec2 p) const;
  [[nodiscard]] std::size_t index(int column, int row) const;  // both in pitches

  Lattice lattice_;
  std::vector<State> points_;
};

}  // namespace orca::sim::detail
