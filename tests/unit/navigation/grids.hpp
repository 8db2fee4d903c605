// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orca/navigation/known_map.hpp"
#include "orca/navigation/map_localizer.hpp"
#include "walls.hpp"

namespace orca::test {

/// The walls drawn into a grid as a map keeps them, free everywhere else between two corners.
inline nav::FloorGrid grid_of(const Walls& walls, Vec2 low, Vec2 high, double side = 0.05) {
  nav::FloorGrid grid{
      {low, side, static_cast<int>((high.x - low.x) / side), static_cast<int>((high.y - low.y) / side)}, {}};
  grid.cells.assign(grid.lattice.size(), 0);
  for (const Wall& wall : walls)
    (void)nav::walk_line(grid.lattice, wall.from, wall.to, [&](nav::Cell cell) {
      if (grid.lattice.holds(cell)) grid.cells[grid.lattice.index(cell)] = 100;
      return true;
    });
  return grid;
}

/// Two rooms with a door between them, no two places alike.
inline Walls two_rooms() {
  Walls walls = box({0.03, 0.02}, {10.02, 6.04});
  for (const Walls& more :
       {Walls{{{5.02, 0.0}, {5.02, 2.5}}, {{5.02, 3.5}, {5.02, 6.0}}}, box({1.0, 4.7}, {2.6, 5.5}),
        box({7.2, 0.6}, {7.6, 1.3}), box({8.6, 4.1}, {10.0, 4.9})})
    walls.insert(walls.end(), more.begin(), more.end());
  return walls;
}

inline nav::FloorGrid two_rooms_grid() { return grid_of(two_rooms(), {-0.5, -0.5}, {10.5, 6.5}); }

/// A scan as a localizer takes it.
inline nav::RobotScan robot_scan(const Walls& walls, const Pose2& X_MR, RandomStream& random) {
  return {1, {}, scan_of(walls, X_MR, 0.01, random), 181};
}

}  // namespace orca::test
