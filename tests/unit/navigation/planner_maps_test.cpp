// SPDX-License-Identifier: GPL-3.0-or-later
// Planning on public maps.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "moving_ai.hpp"
#include "public_text.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::nav;
using namespace orca::test;

namespace {

bool can_step(const GameMap& map, Cell from, Cell to) {
  const auto passable = [&](Cell cell) {
    return map.lattice.holds(cell) && map.costs[map.lattice.index(cell)] != 0;
  };
  const bool beside = std::abs(to.column - from.column) <= 1 && std::abs(to.row - from.row) <= 1;
  return beside && passable(to) && passable({to.column, from.row}) && passable({from.column, to.row});
}

// Returns the length of a way in sides of a cell; infinity if it takes a step that is not allowed.
double length_of(const GameMap& map, const CellWay& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.cells.size(); ++i) {
    const Cell a = way.cells[i - 1];
    const Cell b = way.cells[i];
    if (!can_step(map, a, b)) return INFINITY;
    length += a.column != b.column && a.row != b.row ? std::numbers::sqrt2 : 1.0;
  }
  return length;
}

// Lengths are published with six digits.
double last_digit(double length) {
  return std::pow(10.0, std::floor(std::log10(std::max(length, 1.0))) - 5.0);
}

}  // namespace

TEST_CASE("every way through the maps of MovingAI is as short as the published one", "[navigation][maps]") {
  for (const std::string name :
       {"arena", "den312d", "lak303d", "Berlin_0_256", "16room_000", "maze512-32-0"}) {
    CAPTURE(name);
    const std::string cells = public_text("movingai/" + name + ".map.gz");
    const std::string asked = public_text("movingai/" + name + ".map.scen.gz");
    if (cells.empty() || asked.empty()) return;
    const GameMap map = read_game_map(cells);
    const std::vector<GameQuery> queries = read_game_queries(asked);
    REQUIRE(map.costs.size() == map.lattice.size());
    REQUIRE(queries.size() >= 160);
    GridSearch search(kShortest);
    std::size_t shortest = 0;
    std::size_t tried = 0;
    for (std::size_t i = 0; i < queries.size(); i += is_slow_run() ? 1 : 10, ++tried) {
      const CellWay way = search(map.lattice, map.costs, queries[i].start, queries[i].goal);
      const double off = std::fabs(length_of(map, way) - queries[i].shortest);
      if (way.complete && off < last_digit(queries[i].shortest)) ++shortest;
    }
    CHECK(shortest == tried);
  }
}
