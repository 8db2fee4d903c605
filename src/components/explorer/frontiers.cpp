// SPDX-License-Identifier: LGPL-3.0-or-later
#include "frontiers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <queue>

#include "orca/navigation/distance_transform.hpp"

namespace orca::explore {
namespace {

using nav::Cell;
using nav::FloorGrid;
using nav::Lattice;

constexpr std::array<Cell, 8> kAround{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
constexpr double kNowhere = -1.0;

Cell beside(Cell cell, Cell step) { return {cell.column + step.column, cell.row + step.row}; }

constexpr double kOwnRoom = 0.4;  // [m] around the robot: it is there, so it can leave

// Returns of each cell whether the robot's middle may be there: it is known to be free, and so far from what is occupied, or near the robot.
std::vector<std::uint8_t> passable_cells(const FloorGrid& map, double clearance, Vec2 robot) {
  const Lattice& lattice = map.lattice;
  std::vector<std::uint8_t> obstacles(lattice.size());
  for (std::size_t i = 0; i < obstacles.size(); ++i) obstacles[i] = map.occupied(lattice.cell_of(i)) ? 1 : 0;
  const double cells = clearance / lattice.side;
  nav::DistanceTransform transform;
  const auto squared =
      transform(obstacles, lattice.columns, lattice.rows, static_cast<int>(std::ceil(cells)) + 1);
  std::vector<std::uint8_t> passable(lattice.size());
  for (std::size_t i = 0; i < passable.size(); ++i)
    passable[i] =
        map.free(lattice.cell_of(i)) && (squared[i] >= cells * cells ||
                                         norm(lattice.middle_of(lattice.cell_of(i)) - robot) < kOwnRoom)
            ? 1
            : 0;
  return passable;
}

// Returns the length [m] of the way to each cell by steps to its eight neighbours; kNowhere: none leads there.
std::vector<double> ways_from(const Lattice& lattice, const std::vector<std::uint8_t>& passable, Cell robot) {
  std::vector<double> ways(lattice.size(), kNowhere);
  using Reached = std::pair<double, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  open.emplace(0.0, lattice.index(robot));
  while (!open.empty()) {
    const auto [way, index] = open.top();
    open.pop();
    if (ways[index] != kNowhere) continue;
    ways[index] = way;
    const Cell cell = lattice.cell_of(index);
    for (const Cell step : kAround) {
      const Cell next = beside(cell, step);
      if (!lattice.holds(next) || passable[lattice.index(next)] == 0) continue;
      if (ways[lattice.index(next)] != kNowhere) continue;
      const bool diagonal = step.column != 0 && step.row != 0;
      open.emplace(way + lattice.side * (diagonal ? std::sqrt(2.0) : 1.0), lattice.index(next));
    }
  }
  return ways;
}

// Returns whether something beside a cell has never been seen. Beyond the edge of the map nothing has.
bool borders_on_unknown(const FloorGrid& map, Cell cell) {
  return std::ranges::any_of(kAround, [&](Cell step) {
    const Cell next = beside(cell, step);
    return !map.free(next) && !map.occupied(next);
  });
}

Frontier frontier_of(const Lattice& lattice, const std::vector<std::size_t>& cells,
                     const std::vector<double>& ways) {
  Vec2 sum{};
  for (const std::size_t index : cells) sum = sum + lattice.middle_of(lattice.cell_of(index));
  const Vec2 middle = (1.0 / static_cast<double>(cells.size())) * sum;
  const std::size_t best = *std::ranges::min_element(
      cells, {}, [&](std::size_t index) { return norm(lattice.middle_of(lattice.cell_of(index)) - middle); });
  return {lattice.middle_of(lattice.cell_of(best)), static_cast<double>(cells.size()) * lattice.side,
          ways[best]};
}

}  // namespace

std::vector<Frontier> frontiers(const FloorGrid& map, double clearance, Vec2 robot, double least) {
  const Lattice& lattice = map.lattice;
  const Cell here = lattice.cell_at(robot);
  if (!lattice.holds(here)) return {};
  const std::vector<double> ways = ways_from(lattice, passable_cells(map, clearance, robot), here);

  std::vector<std::uint8_t> is_border(lattice.size());
  for (std::size_t i = 0; i < is_border.size(); ++i)
    is_border[i] = ways[i] != kNowhere && borders_on_unknown(map, lattice.cell_of(i)) ? 1 : 0;

  std::vector<Frontier> found;
  for (std::size_t first = 0; first < is_border.size(); ++first) {
    if (is_border[first] == 0) continue;
    std::vector<std::size_t> cells{first};
    is_border[first] = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (const Cell step : kAround) {
        const Cell next = beside(lattice.cell_of(cells[i]), step);
        if (!lattice.holds(next) || is_border[lattice.index(next)] == 0) continue;
        is_border[lattice.index(next)] = 0;
        cells.push_back(lattice.index(next));
      }
    }
    const Frontier frontier = frontier_of(lattice, cells, ways);
    if (frontier.width >= least) found.push_back(frontier);
  }
  std::ranges::stable_sort(found, {}, &Frontier::way);
  return found;
}

}  // namespace orca::explore
