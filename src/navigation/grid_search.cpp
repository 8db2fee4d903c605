// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/grid_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <functional>
#include <utility>

namespace orca::nav {
namespace {

constexpr int kCellBits = 24;
// Below the round in the mark of a node: whether it is closed, and the direction that led there.
constexpr std::uint32_t kStart = 8;
constexpr std::uint32_t kDirectionBits = 15;
constexpr std::uint32_t kIsClosed = 16;
// A bucket is at most as wide as a straight step over plain cells. A step over the dearest cells away from the goal leads less than this many on.
constexpr std::size_t kBuckets = 512;

struct Direction {
  int column;
  int row;
};
constexpr std::array<Direction, 8> kDirections{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
constexpr std::uint32_t kDiagonals = 4;  // the directions from this one on

std::int64_t squared_distance(Cell cell, Cell goal) {
  const std::int64_t columns = cell.column - goal.column;
  const std::int64_t rows = cell.row - goal.row;
  return columns * columns + rows * rows;
}

// As Lattice::cell_of(), but faster: the number of a cell has few digits.
Cell cell_of(const Lattice& lattice, std::size_t index) {
  const auto number = static_cast<std::uint32_t>(index);
  const auto columns = static_cast<std::uint32_t>(lattice.columns);
  const std::uint32_t row = number / columns;
  return {static_cast<int>(number - row * columns), static_cast<int>(row)};
}

// Returns by which directions ways lead on from a cell between equal cells, as bits: straight ahead, and behind a diagonal step also along both
// sides of it. All others are reached from the cell before as cheaply without this cell.
std::uint32_t natural_directions(std::uint32_t from) {
  constexpr std::uint32_t kAll = 0xFF;
  if (from == kStart) return kAll;
  if (from < kDiagonals) return 1U << from;
  return 1U << from | 1U << (from - kDiagonals) | 1U << ((from + 1) % kDiagonals);
}

// Returns the costs of the cells around one, in the order of kDirections; 0 outside of the lattice.
std::array<std::uint16_t, 8> costs_around(const Lattice& lattice, std::span<const std::uint16_t> costs,
                                          Cell cell) {
  std::array<std::uint16_t, 8> around{};
  const bool within =
      cell.column > 0 && cell.row > 0 && cell.column + 1 < lattice.columns && cell.row + 1 < lattice.rows;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Cell next{cell.column + kDirections[i].column, cell.row + kDirections[i].row};
    if (within || lattice.holds(next)) around[i] = costs[lattice.index(next)];
  }
  return around;
}

}  // namespace

GridSearch::GridSearch(SearchRules rules)
    : rules_(rules), shift_(static_cast<int>(std::bit_width(rules.straight * kPlainCost)) - 1) {}

CellWay GridSearch::operator()(const Lattice& lattice, std::span<const std::uint16_t> costs, Cell start,
                               Cell goal, std::span<const std::uint8_t> forbidden) {
  const Task task{lattice, costs, goal, forbidden};
  begin(costs.size());
  turn_ = least_cost(start, goal) >> shift_;
  open(task, start, 0, kStart);
  const std::size_t end = lattice.index(goal);
  std::size_t nearest = lattice.index(start);
  std::int64_t distance = squared_distance(start, goal);
  const auto arrived = [&] { return is_found(end) && nodes_[end].cost >> shift_ < turn_; };
  for (auto index = take(); index && !arrived(); index = take()) {
    if ((nodes_[*index].mark & kIsClosed) != 0) continue;
    nodes_[*index].mark |= kIsClosed;
    const Cell cell = cell_of(lattice, *index);
    const std::int64_t off = squared_distance(cell, goal);
    if (off < distance) {
      distance = off;
      nearest = *index;
    }
    expand(task, cell, *index);
  }
  CellWay way = way_to(lattice, is_found(end) ? end : nearest);
  way.complete = is_found(end);
  return way;
}

void GridSearch::flood(const Lattice& lattice, std::span<const std::uint16_t> costs, Cell goal, Cell start,
                       std::uint32_t beyond) {
  const Task task{lattice, costs, start, {}, true};
  begin(costs.size());
  turn_ = 0;
  open(task, goal, 0, kStart);
  const std::size_t end = lattice.index(start);
  const auto done = [&] {
    return is_found(end) && (std::uint64_t{nodes_[end].cost} + beyond) >> shift_ < turn_;
  };
  for (auto index = take(); index && !done(); index = take()) {
    if ((nodes_[*index].mark & kIsClosed) != 0) continue;
    nodes_[*index].mark |= kIsClosed;
    expand(task, cell_of(lattice, *index), *index);
  }
}

void GridSearch::begin(std::size_t cells) {
  nodes_.resize(cells);
  buckets_.resize(kBuckets);
  for (std::vector<std::uint64_t>& bucket : buckets_) bucket.clear();
  waiting_ = 0;
  if (round_ == UINT32_MAX >> kRoundShift) {
    std::ranges::fill(nodes_, Node{});
    round_ = 0;
  }
  ++round_;
}

// Returns the cost of the way to the goal if nothing made it dearer.
std::uint32_t GridSearch::least_cost(Cell cell, Cell goal) const {
  const auto columns = static_cast<std::uint32_t>(std::abs(cell.column - goal.column));
  const auto rows = static_cast<std::uint32_t>(std::abs(cell.row - goal.row));
  const std::uint32_t diagonal = std::min(columns, rows);
  return (rules_.diagonal * diagonal + rules_.straight * (std::max(columns, rows) - diagonal)) * kPlainCost;
}

void GridSearch::open(const Task& task, Cell cell, std::uint32_t cost, std::uint32_t from) {
  const std::size_t index = task.lattice.index(cell);
  Node& node = nodes_[index];
  if (is_found(index) && node.cost <= cost) return;
  node = {cost, round_ << kRoundShift | from};
  const std::uint64_t whole = std::uint64_t{cost} + (task.floods ? 0 : least_cost(cell, task.goal));
  const std::uint64_t turn = whole >> shift_;
  std::vector<std::uint64_t>& bucket = buckets_[turn % kBuckets];
  bucket.push_back(whole << kCellBits | index);
  if (rules_.ordered && turn == turn_) std::ranges::push_heap(bucket, std::greater<>{});
  ++waiting_;
}

// Takes the cell out whose whole way is estimated to be cheapest, if not ordered to within a bucket.
std::optional<std::size_t> GridSearch::take() {
  if (waiting_ == 0) return std::nullopt;
  const bool used_up = buckets_[turn_ % kBuckets].empty();
  while (buckets_[turn_ % kBuckets].empty()) ++turn_;
  std::vector<std::uint64_t>& bucket = buckets_[turn_ % kBuckets];
  if (rules_.ordered && used_up) std::ranges::make_heap(bucket, std::greater<>{});
  if (rules_.ordered) std::ranges::pop_heap(bucket, std::greater<>{});
  const std::size_t index = bucket.back() & ((1U << kCellBits) - 1);
  bucket.pop_back();
  --waiting_;
  return index;
}

void GridSearch::expand(const Task& task, Cell cell, std::size_t index) {
  const std::array<std::uint16_t, 8> around = costs_around(task.lattice, task.costs, cell);
  const std::uint32_t here = std::max(task.costs[index], kPlainCost);
  const std::uint32_t so_far = nodes_[index].cost;
  const bool level = !rules_.ordered && task.forbidden.empty() &&
                     std::ranges::all_of(around, [&](auto cost) { return cost == here; });
  const std::uint32_t ways = level ? natural_directions(nodes_[index].mark & kDirectionBits) : 0xFF;
  for (std::size_t i = 0; i < kDirections.size(); ++i) {
    if (around[i] == 0 || (ways >> i & 1U) == 0) continue;
    const bool diagonal = i >= kDiagonals;
    // A diagonal lies between the direction of its own number and the next one.
    if (diagonal && (around[i - kDiagonals] == 0 || around[(i + 1) % kDiagonals] == 0)) continue;
    const std::uint32_t length = diagonal ? rules_.diagonal : rules_.straight;
    const Cell next{cell.column + kDirections[i].column, cell.row + kDirections[i].row};
    if (!task.forbidden.empty() &&
        ((task.forbidden[index] | task.forbidden[task.lattice.index(next)]) >> i & 1U) != 0)
      continue;
    open(task, next, so_far + length * (here + around[i]) / 2, static_cast<std::uint32_t>(i));
  }
}

CellWay GridSearch::way_to(const Lattice& lattice, std::size_t end) const {
  CellWay way;
  way.cost = nodes_[end].cost;
  Cell cell = lattice.cell_of(end);
  way.cells.push_back(cell);
  const auto from = [&] { return nodes_[lattice.index(cell)].mark & kDirectionBits; };
  while (from() != kStart) {
    const Direction& step = kDirections[from()];
    cell = {cell.column - step.column, cell.row - step.row};
    way.cells.push_back(cell);
  }
  std::ranges::reverse(way.cells);
  return way;
}

}  // namespace orca::nav
