// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orca::sim {
namespace {

constexpr double kMostCells = 4e6;
constexpr double kTouch = 1e-6;  // [cells] What reaches no farther into a cell than this only touches it.

// The whole cells of a row or column in which something from `low` to `high` [cells] lies, as [first, end).
struct Range {
  std::size_t first;
  std::size_t end;
};
Range range_of(double low, double high, std::size_t count) {
  const auto clamped = [count](double at) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count)));
  };
  return {clamped(std::floor(low + kTouch)), clamped(std::floor(high - kTouch) + 1.0)};
}

// A grid that is being filled. Lengths are in cells, from its corner.
class Filling {
 public:
  explicit Filling(Occupancy& grid) : grid_(grid) {}

  void add(const Obstacle& obstacle, double height) {
    if (bounds_of(obstacle.shape).empty()) return;
    const std::vector<Segment> edges = edges_of(obstacle.shape);
    if (edges.empty() || obstacle.mesh) return add_by_cells(obstacle, height);
    if (obstacle.bottom < height && obstacle.height > 0.0) add_by_rows(edges);
  }

 private:
  void mark(std::size_t row, double low, double high) {
    const Range columns = range_of(low, high, grid_.columns);
    for (std::size_t column = columns.first; column < columns.end; ++column)
      grid_.cells[row * grid_.columns + column] = true;
  }

  [[nodiscard]] Vec2 in_cells(Vec2 p) const { return (1.0 / grid_.resolution) * (p - grid_.corner); }

  void add_by_cells(const Obstacle& obstacle, double height) {
    const Bounds bounds = bounds_of(obstacle.shape);
    const Vec2 low = in_cells(bounds.low);
    const Vec2 high = in_cells(bounds.high);
    const Range rows = range_of(low.y, high.y, grid_.rows);
    const Range columns = range_of(low.x, high.x, grid_.columns);
    const double half = (0.5 - kTouch) * grid_.resolution;
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      for (std::size_t column = columns.first; column < columns.end; ++column) {
        const Vec2 middle{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
        const Vec2 at = grid_.corner + grid_.resolution * middle;
        if (overlap(obstacle, Box{{at.x, at.y, 0.0}, {half, half}}, 0.0, height))
          mark(row, static_cast<double>(column), static_cast<double>(column) + 1.0);
      }
    }
  }

  // Marks the cells through which the edges pass, and between them those that lie inside.
  void add_by_rows(const std::vector<Segment>& edges) {
    std::vector<std::vector<double>> crossings(grid_.rows);
    for (const Segment& edge : edges) add_edge(in_cells(edge.a), in_cells(edge.b), crossings);
    for (std::size_t row = 0; row < grid_.rows; ++row) {
      std::ranges::sort(crossings[row]);
      for (std::size_t k = 0; k + 1 < crossings[row].size(); k += 2)
        mark(row, crossings[row][k], crossings[row][k + 1]);
    }
  }

  void add_edge(Vec2 a, Vec2 b, std::vector<std::vector<double>>& crossings) {
    if (a.y > b.y) std::swap(a, b);
    const Range rows = range_of(a.y, b.y, grid_.rows);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      const auto bottom = static_cast<double>(row);
      const double from = x_at(a, b, std::max(a.y, bottom));
      const double to = a.y == b.y ? b.x : x_at(a, b, std::min(b.y, bottom + 1.0));
      mark(row, std::min(from, to), std::max(from, to));
      const double middle = bottom + 0.5;
      if ((a.y <= middle) != (b.y <= middle)) crossings[row].push_back(x_at(a, b, middle));
    }
  }

  static double x_at(Vec2 a, Vec2 b, double y) {
    return a.y == b.y ? a.x : a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
  }

  Occupancy& grid_;
};

}  // namespace

Result<Occupancy> occupancy_of(const WorldModel& world, double resolution, double height) {
  if (!(resolution > 0.0)) return fail(Code::invalid_argument, "the side of a cell must be positive");
  const Bounds bounds = world.bounds();
  const Vec2 size = bounds.empty() ? Vec2{} : bounds.high - bounds.low;
  const auto cells_along = [&](double length) {
    return std::max(1.0, std::ceil(length / resolution - kTouch));
  };
  const double columns = cells_along(size.x);
  const double rows = cells_along(size.y);
  if (!(columns * rows <= kMostCells))
    return fail(Code::invalid_argument, "the map would have more than 4 million cells; make them larger");
  Occupancy grid{.corner = bounds.empty() ? Vec2{} : bounds.low,
                 .resolution = resolution,
                 .columns = static_cast<std::size_t>(columns),
                 .rows = static_cast<std::size_t>(rows),
                 .cells = {}};
  grid.cells.resize(grid.columns * grid.rows);
  Filling filling(grid);
  for (const Obstacle& obstacle : world.obstacles) filling.add(obstacle, height);
  return grid;
}

}  // namespace orca::sim
