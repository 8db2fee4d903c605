// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/grid_search.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <utility>

namespace orca::nav {
namespace {

constexpr std::uint32_t kStraight = 5;
constexpr std::uint32_t kDiagonal = 7;
constexpr int kCellBits = 24;
constexpr std::int8_t kStart = -1;

struct Direction {
  int column;
  int row;
  std::uint32_t length;
};
constexpr std::array<Direction, 8> kDirections{{{1, 0, kStraight},
                                                {0, 1, kStraight},
                                                {-1, 0, kStraight},
                                                {0, -1, kStraight},
                                                {1, 1, kDiagonal},
                                                {-1, 1, kDiagonal},
                                                {-1, -1, kDiagonal},
                                                {1, -1, kDiagonal}}};

// Returns the cost of the way to the goal if nothing made it dearer.
std::uint32_t least_cost(Cell cell, Cell goal) {
  const auto columns = static_cast<std::uint32_t>(std::abs(cell.column - goal.column));
  const auto rows = static_cast<std::uint32_t>(std::abs(cell.row - goal.row));
  const std::uint32_t diagonal = std::min(columns, rows);
  return (kDiagonal * diagonal + kStraight * (std::max(columns, rows) - diagonal)) * kPlainCost;
}

std::int64_t squared_distance(Cell cell, Cell goal) {
  const std::int64_t columns = cell.column - goal.column;
  const std::int64_t rows = cell.row - goal.row;
  return columns * columns + rows * rows;
}

}  // namespace

CellWay GridSearch::operator()(const Lattice& lattice, std::span<const std::uint16_t> costs, Cell start,
                               Cell goal) {
  nodes_.resize(costs.size());
  heap_.clear();
  ++round_;
  open(lattice.index(start), 0, kStart, least_cost(start, goal));
  const std::size_t end = lattice.index(goal);
  std::size_t nearest = lattice.index(start);
  std::int64_t distance = squared_distance(start, goal);
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>{});
    const std::size_t index = heap_.back() & ((1U << kCellBits) - 1);
    heap_.pop_back();
    if (std::exchange(nodes_[index].closed, true)) continue;
    if (index == end) break;
    const std::int64_t off = squared_distance(lattice.cell_of(index), goal);
    if (off < distance) {
      distance = off;
      nearest = index;
    }
    expand(lattice, costs, index, goal);
  }
  const bool complete = nodes_[end].round == round_ && nodes_[end].closed;
  CellWay way = way_to(lattice, complete ? end : nearest);
  way.complete = complete;
  return way;
}

void GridSearch::open(std::size_t index, std::uint32_t cost, std::int8_t from, std::uint32_t estimate) {
  Node& node = nodes_[index];
  if (node.round == round_ && (node.closed || node.cost <= cost)) return;
  node = {cost, round_, from, false};
  heap_.push_back((static_cast<std::uint64_t>(cost + estimate) << kCellBits) | index);
  std::push_heap(heap_.begin(), heap_.end(), std::greater<>{});
}

void GridSearch::expand(const Lattice& lattice, std::span<const std::uint16_t> costs, std::size_t index,
                        Cell goal) {
  const Cell cell = lattice.cell_of(index);
  const auto cost_at = [&](Cell at) {
    return lattice.holds(at) ? costs[lattice.index(at)] : std::uint16_t{0};
  };
  const std::uint32_t here = std::max(costs[index], kPlainCost);
  for (std::size_t i = 0; i < kDirections.size(); ++i) {
    const Direction& step = kDirections[i];
    const Cell next{cell.column + step.column, cell.row + step.row};
    const std::uint32_t there = cost_at(next);
    if (there == 0) continue;
    const bool cuts = step.length == kDiagonal &&
                      (cost_at({next.column, cell.row}) == 0 || cost_at({cell.column, next.row}) == 0);
    if (cuts) continue;
    open(lattice.index(next), nodes_[index].cost + step.length * (here + there) / 2,
         static_cast<std::int8_t>(i), least_cost(next, goal));
  }
}

CellWay GridSearch::way_to(const Lattice& lattice, std::size_t end) const {
  CellWay way;
  way.cost = nodes_[end].cost;
  Cell cell = lattice.cell_of(end);
  way.cells.push_back(cell);
  for (std::int8_t from = nodes_[end].from; from != kStart; from = nodes_[lattice.index(cell)].from) {
    const Direction& step = kDirections[static_cast<std::size_t>(from)];
    cell = {cell.column - step.column, cell.row - step.row};
    way.cells.push_back(cell);
  }
  std::reverse(way.cells.begin(), way.cells.end());
  return way;
}

}  // namespace orca::nav
