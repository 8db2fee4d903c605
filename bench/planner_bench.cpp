// SPDX-License-Identifier: GPL-3.0-or-later
// The time of a plan: the mean of many ways through a map. A reference is the same search with one queue in order, as GridPlanner searches.
#include <cstddef>
#include <string>
#include <vector>

#include "benchmarks.hpp"
#include "comparison.hpp"
#include "moving_ai.hpp"
#include "orca/base/random.hpp"
#include "public_text.hpp"

namespace orca::bench {
namespace {

using test::GameMap;
using test::GameQuery;

/// A map and ways through it.
struct Trial {
  GameMap map;
  std::vector<GameQuery> queries;
};

/// Returns 200 queries of the two maps of 512 x 512 cells, in proportion to how many each has; none without the data.
std::vector<Trial> game_trials() {
  constexpr std::size_t kEvery = 38;
  std::vector<Trial> trials;
  for (const std::string name : {"16room_000", "maze512-32-0"}) {
    const std::string cells = test::public_text("movingai/" + name + ".map.gz");
    if (cells.empty()) return {};
    Trial trial{test::read_game_map(cells), {}};
    const std::vector<GameQuery> all =
        test::read_game_queries(test::public_text("movingai/" + name + ".map.scen.gz"));
    for (std::size_t i = 0; i < all.size(); i += kEvery) trial.queries.push_back(all[i]);
    trials.push_back(std::move(trial));
  }
  return trials;
}

/// Returns a town of 1024 x 1024 cells: blocks of 8 to 120 cells, of which about 45 % of the floor is covered, and 50 ways from anywhere to
/// anywhere in it.
std::vector<Trial> town_trials() {
  constexpr int kSide = 1024;
  Trial trial{{{{}, 1.0, kSide, kSide}, {}}, {}};
  trial.map.costs.assign(trial.map.lattice.size(), nav::kPlainCost);
  RandomStream random(5, "bench", "town");
  for (int block = 0; block < 160; ++block) {
    const nav::Cell low{static_cast<int>(random.uniform(0.0, kSide)),
                        static_cast<int>(random.uniform(0.0, kSide))};
    const nav::Cell size{static_cast<int>(random.uniform(8.0, 120.0)),
                         static_cast<int>(random.uniform(8.0, 120.0))};
    for (int row = low.row; row < std::min(low.row + size.row, kSide); ++row)
      for (int column = low.column; column < std::min(low.column + size.column, kSide); ++column)
        trial.map.costs[trial.map.lattice.index({column, row})] = 0;
  }
  const auto place = [&] {
    for (;;) {
      const nav::Cell cell{static_cast<int>(random.uniform(0.0, kSide)),
                           static_cast<int>(random.uniform(0.0, kSide))};
      if (trial.map.costs[trial.map.lattice.index(cell)] != 0) return cell;
    }
  };
  for (int i = 0; i < 50; ++i) {
    const nav::Cell from = place();
    trial.queries.push_back({from, place(), 0.0});
  }
  return {trial};
}

Nanoseconds mean_time(const std::vector<Trial>& trials, nav::GridSearch& search) {
  std::size_t count = 0;
  for (const Trial& trial : trials) count += trial.queries.size();
  return time_per_operation(static_cast<int>(count), [&] {
    for (const Trial& trial : trials)
      for (const GameQuery& query : trial.queries)
        benchmark::DoNotOptimize(search(trial.map.lattice, trial.map.costs, query.start, query.goal));
  });
}

void add_search(const std::string& name, Nanoseconds most, std::vector<Trial> trials) {
  if (trials.empty()) return;  // public_text() has said what is missing
  add_row({name, "in order", median_at_most(most)}, 10, [trials](auto& state, Row& row) {
    nav::GridSearch shortest(nav::kShortest);
    nav::GridSearch ordered;
    alternate(
        state, row, 1, [&](int) { return mean_time(trials, shortest); },
        [&](int) { return mean_time(trials, ordered); });
  });
}

}  // namespace

void register_planner() {
  add_search("a way through 512 x 512 cells of MovingAI, mean", 6e6, game_trials());
  add_search("a way through a town of 1024 x 1024 cells, mean", 25e6, town_trials());
}

}  // namespace orca::bench
