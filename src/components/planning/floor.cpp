// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/planning/floor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/geometry/objects/plane.hpp"

namespace orca::planning {
namespace {

Error wrong(const std::string& text) {
  return fail(Code::invalid_argument, "the map says nothing valid: " + text);
}

Status check(const idl::OccupancyGrid& grid, std::uint64_t most) {
  if (!std::isfinite(grid.resolution()) || grid.resolution() < 0.001 || grid.resolution() > 1.0)
    return wrong("its resolution is " + std::to_string(grid.resolution()) + " m; expected 0.001 m to 1 m");
  const std::uint64_t cells = static_cast<std::uint64_t>(grid.columns()) * grid.rows();
  if (cells == 0 || cells > most || cells != grid.cells().size())
    return wrong("it has " + std::to_string(grid.cells().size()) + " cells in " +
                 std::to_string(grid.columns()) + " columns and " + std::to_string(grid.rows()) +
                 " rows; expected columns times rows, at most " + std::to_string(most) +
                 (cells == grid.cells().size() ? "; give a map of larger cells" : ""));
  const std::uint64_t along = std::max(grid.columns(), grid.rows());
  if (along > nav::KnownMap::kMostAlong ||
      static_cast<double>(along) * grid.resolution() > nav::KnownMap::kMostExtent)
    return wrong("it is " + std::to_string(along) + " cells of " + std::to_string(grid.resolution()) +
                 " m long; expected at most " + std::to_string(nav::KnownMap::kMostAlong) + " cells and " +
                 std::to_string(nav::KnownMap::kMostExtent) + " m");
  if (!std::isfinite(grid.corner().x()) || !std::isfinite(grid.corner().y()) ||
      !std::isfinite(grid.corner().orientation()))
    return wrong("its corner is not finite");
  return ok();
}

}  // namespace

Status Floor::take(const idl::OccupancyGrid& grid) {
  if (Status sound = check(grid, most_cells_); !sound.ok()) return sound;
  changed_ = true;
  if (take_tile(grid)) return ok();
  name_ = grid.name();
  yaw_ = wrapped(grid.corner().orientation());
  grid_.lattice = {seen_from(X_WM(), Vec2{grid.corner().x(), grid.corner().y()}), grid.resolution(),
                   static_cast<int>(grid.columns()), static_cast<int>(grid.rows())};
  grid_.cells.assign(grid.cells().begin(), grid.cells().end());
  return ok();
}

bool Floor::take_tile(const idl::OccupancyGrid& grid) {
  const double side = grid_.lattice.side;
  if (grid_.cells.empty() || grid.name() != name_ || grid.resolution() != side) return false;
  const Pose2 X_MT = seen_from(X_WM(), plane_pose(grid.corner()));
  const Vec2 off = 1.0 / side * (X_MT.position() - grid_.lattice.corner);
  if (norm(off) > 1e6) return false;
  const nav::Cell first{static_cast<int>(std::lround(off.x)), static_cast<int>(std::lround(off.y))};
  const nav::Cell last{first.column + static_cast<int>(grid.columns()) - 1,
                       first.row + static_cast<int>(grid.rows()) - 1};
  const bool is_straight = std::fabs(X_MT.yaw) < 1e-6 && std::fabs(off.x - first.column) < 0.01 &&
                           std::fabs(off.y - first.row) < 0.01;
  const bool is_within =
      grid.cells().size() < grid_.cells.size() && grid_.lattice.holds(first) && grid_.lattice.holds(last);
  if (!is_straight || (edge_ == Edge::fixed ? !is_within : !grow_to(first, last))) return false;
  const nav::Cell begin{std::max(first.column, 0), std::max(first.row, 0)};  // where it is after growing
  for (int row = 0; row < static_cast<int>(grid.rows()); ++row)
    std::copy_n(grid.cells().begin() + static_cast<std::ptrdiff_t>(row) * grid.columns(), grid.columns(),
                grid_.cells.begin() +
                    static_cast<std::ptrdiff_t>(grid_.lattice.index({begin.column, begin.row + row})));
  return true;
}

// Makes room for cells beyond the edge: a map that is still being made grows.
// @return whether it can be as large.
bool Floor::grow_to(nav::Cell first, nav::Cell last) {
  const nav::Lattice old = grid_.lattice;
  const nav::Cell low{std::min(first.column, 0), std::min(first.row, 0)};
  const nav::Cell high{std::max(last.column, old.columns - 1), std::max(last.row, old.rows - 1)};
  nav::FloorGrid grown;
  grown.lattice = {old.corner + old.side * Vec2{double(low.column), double(low.row)}, old.side,
                   high.column - low.column + 1, high.row - low.row + 1};
  if (grown.lattice.columns == old.columns && grown.lattice.rows == old.rows) return true;
  if (grown.lattice.size() > most_cells_) return false;
  grown.cells.assign(grown.lattice.size(), nav::FloorGrid::kUnknown);
  for (int row = 0; row < old.rows; ++row)
    std::copy_n(
        grid_.cells.begin() + static_cast<std::ptrdiff_t>(old.index({0, row})), old.columns,
        grown.cells.begin() + static_cast<std::ptrdiff_t>(grown.lattice.index({-low.column, row - low.row})));
  grid_ = std::move(grown);
  return true;
}

std::shared_ptr<const nav::KnownMap> Floor::map() {
  changed_ = false;
  return grid_.cells.empty() ? nullptr : std::make_shared<const nav::KnownMap>(grid_);
}

}  // namespace orca::planning
