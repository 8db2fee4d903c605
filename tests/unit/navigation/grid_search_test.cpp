// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/grid_search.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <vector>

#include "orca/base/random.hpp"

using namespace orca::nav;

namespace {

struct Field {
  Lattice lattice;
  std::vector<std::uint16_t> costs;
  Cell start;
  Cell goal;
  [[nodiscard]] bool passable(Cell cell) const {
    return lattice.holds(cell) && costs[lattice.index(cell)] != 0;
  }
};

constexpr std::array kBothRules{SearchRules{}, kShortest};

// A field of cells of many costs, or of few, with large parts alike.
Field random_field(orca::RandomStream& random, bool level) {
  Field field{
      {{}, 0.1, static_cast<int>(random.uniform(2.0, 25.0)), static_cast<int>(random.uniform(2.0, 25.0))},
      {},
      {},
      {}};
  for (std::size_t i = 0; i < field.lattice.size(); ++i)
    field.costs.push_back(
        random.chance(0.3) ? 0 : static_cast<std::uint16_t>(random.uniform(kPlainCost, 10.0 * kPlainCost)));
  for (std::uint16_t& cost : field.costs)
    if (level) cost = random.chance(0.03) ? 0 : random.chance(0.03) ? 2 * kPlainCost : kPlainCost;
  const auto cell = [&] {
    return Cell{static_cast<int>(random.uniform(0.0, field.lattice.columns)),
                static_cast<int>(random.uniform(0.0, field.lattice.rows))};
  };
  field.start = cell();
  field.goal = cell();
  return field;
}

// Returns the cost of a step, 0 if it is not allowed: the rules of GridSearch, said once more.
std::uint32_t cost_of_step(const Field& field, const SearchRules& rules, Cell from, Cell to) {
  const int columns = std::abs(from.column - to.column);
  const int rows = std::abs(from.row - to.row);
  if (std::max(columns, rows) != 1 || !field.passable(to)) return 0;
  const bool diagonal = columns + rows == 2;
  if (diagonal && !(field.passable({to.column, from.row}) && field.passable({from.column, to.row}))) return 0;
  const std::uint32_t both =
      std::max(field.costs[field.lattice.index(from)], kPlainCost) + field.costs[field.lattice.index(to)];
  return (diagonal ? rules.diagonal : rules.straight) * both / 2;
}

constexpr std::uint32_t kNever = UINT32_MAX;

// Returns the cost of the cheapest way to each cell: every step is tried until nothing gets cheaper.
std::vector<std::uint32_t> cheapest(const Field& field, const SearchRules& rules) {
  std::vector<std::uint32_t> best(field.costs.size(), kNever);
  best[field.lattice.index(field.start)] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < best.size(); ++i)
      for (int k = 0; k < 9 && best[i] != kNever; ++k) {
        const Cell from = field.lattice.cell_of(i);
        const Cell to{from.column + k % 3 - 1, from.row + k / 3 - 1};
        const std::uint32_t step = cost_of_step(field, rules, from, to);
        if (step == 0 || best[i] + step >= best[field.lattice.index(to)]) continue;
        best[field.lattice.index(to)] = best[i] + step;
        changed = true;
      }
  }
  return best;
}

std::uint32_t cost_of(const Field& field, const SearchRules& rules, const CellWay& way) {
  std::uint32_t sum = 0;
  for (std::size_t i = 1; i < way.cells.size(); ++i) {
    const std::uint32_t step = cost_of_step(field, rules, way.cells[i - 1], way.cells[i]);
    if (step == 0) return kNever;
    sum += step;
  }
  return sum;
}

int squared(Cell a, Cell b) {
  return (a.column - b.column) * (a.column - b.column) + (a.row - b.row) * (a.row - b.row);
}

}  // namespace

TEST_CASE("A* finds ways as cheap as the cheapest of all, by allowed steps, and knows when there is none",
          "[navigation]") {
  const SearchRules rules = GENERATE(from_range(kBothRules.begin(), kBothRules.end()));
  const bool level = GENERATE(false, true);
  orca::RandomStream random(3, "test", "fields");
  GridSearch search(rules);
  int reached = 0;
  for (int i = 0; i < 300; ++i) {
    const Field field = random_field(random, level);
    const std::vector<std::uint32_t> best = cheapest(field, rules);
    const CellWay way = search(field.lattice, field.costs, field.start, field.goal);
    CAPTURE(i, rules.ordered, level);
    REQUIRE(way.cells.front() == field.start);
    CHECK(way.complete == (best[field.lattice.index(field.goal)] != kNever));
    CHECK(way.cost == best[field.lattice.index(way.cells.back())]);
    CHECK(cost_of(field, rules, way) == way.cost);
    reached += way.complete ? 1 : 0;
  }
  CHECK(reached > 100);
  CHECK((level || reached < 250));
}

TEST_CASE("a way to a goal that cannot be reached ends in the reachable cell nearest to it", "[navigation]") {
  const SearchRules rules = GENERATE(from_range(kBothRules.begin(), kBothRules.end()));
  orca::RandomStream random(4, "test", "fields");
  GridSearch search(rules);
  for (int i = 0; i < 300; ++i) {
    const Field field = random_field(random, false);
    const CellWay way = search(field.lattice, field.costs, field.start, field.goal);
    if (way.complete) continue;
    const std::vector<std::uint32_t> best = cheapest(field, rules);
    int nearest = squared(field.start, field.goal);
    for (std::size_t k = 0; k < best.size(); ++k)
      if (best[k] != kNever) nearest = std::min(nearest, squared(field.lattice.cell_of(k), field.goal));
    CAPTURE(i, rules.ordered);
    CHECK(squared(way.cells.back(), field.goal) == nearest);
  }
}
