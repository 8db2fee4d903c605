// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <deque>
#include <set>
#include <utility>

#include "orca/sim/world_model.hpp"

namespace orca::sim::test {

// The cells that a disc can reach from a place.
class Plan {
 public:
  Plan(const WorldModel& world, Vec2 start, double radius) : world_(world), radius_(radius) {
    std::deque<Cell> open{cell(start)};
    if (free(open.front())) reached_.insert(open.front());
    while (!open.empty()) {
      const auto [x, y] = open.front();
      open.pop_front();
      for (const Cell& next : {Cell{x + 1, y}, Cell{x - 1, y}, Cell{x, y + 1}, Cell{x, y - 1}})
        if (!reached_.contains(next) && free(next)) {
          reached_.insert(next);
          open.push_back(next);
        }
    }
  }
  [[nodiscard]] bool reaches(Vec2 p) const { return reached_.contains(cell(p)); }

 private:
  using Cell = std::pair<int, int>;
  static Cell cell(Vec2 p) {
    return {static_cast<int>(std::lround(p.x / kCell)), static_cast<int>(std::lround(p.y / kCell))};
  }
  [[nodiscard]] bool free(Cell c) const {
    const Vec2 p{c.first * kCell, c.second * kCell};
    return world_.obstacle_at(Circle{p, radius_}, 0.0) == nullptr;
  }
  static constexpr double kCell = 0.05;  // [m]
  const WorldModel& world_;
  double radius_;
  std::set<Cell> reached_;
};

}  // namespace orca::sim::test
