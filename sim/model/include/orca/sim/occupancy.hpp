// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim {

/// The cells of a grid over a world that its obstacles cover.
struct Occupancy {
  Vec2 corner;              ///< [m] Lower left corner of the first cell, world frame.
  double resolution = 0.0;  ///< [m] Side of a cell.
  std::size_t columns = 0;  ///< Cells in a row, along x.
  std::size_t rows = 0;     ///< Rows, along y.
  std::vector<bool>
      cells;  ///< Row by row, that of the lowest y first; true: part of an obstacle lies in the cell.
};

/// Returns the cells that hold a part of an obstacle between the floor and `height` [m]. People are left out. An
/// obstacle that only touches the boundary of a cell does not count.
/// @errors  invalid_argument if the world needs more than 4 million cells, or the resolution is not positive.
/// @thread  pure function; any thread.
[[nodiscard]] Result<Occupancy> occupancy_of(const WorldModel& world, double resolution, double height);

/// Fills in an idl::OccupancyGrid, which the simulator does not know: cells are 100, occupied, or 0, free. The name stays as it is.
/// @thread  as for the grid.
template <class Grid>
void fill(Grid& grid, const Occupancy& from) {
  grid.corner().x(from.corner.x);
  grid.corner().y(from.corner.y);
  grid.resolution(from.resolution);
  grid.columns(static_cast<std::uint32_t>(from.columns));
  grid.rows(static_cast<std::uint32_t>(from.rows));
  grid.cells().clear();
  for (const bool covered : from.cells) grid.cells().push_back(covered ? 100 : 0);
}

}  // namespace orca::sim
