// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "orca/navigation/grid_search.hpp"

namespace orca::test {

/// A map of the MovingAI collection, as costs of its cells. Its rows count downwards in the file; here they are rows of the lattice as they come.
/// @source  Sturtevant, "Benchmarks for Grid-Based Pathfinding", IEEE Trans. on Computational Intelligence and AI in Games 4, 2012.
struct GameMap {
  nav::Lattice lattice;
  std::vector<std::uint16_t> costs;
};

/// A way that is asked for, with the length of the shortest one in sides of a cell.
struct GameQuery {
  nav::Cell start, goal;
  double shortest;
};

inline GameMap read_game_map(const std::string& text) {
  GameMap map;
  std::istringstream lines(text);
  std::string word;
  while (lines >> word && word != "map") {
    if (word == "height") lines >> map.lattice.rows;
    if (word == "width") lines >> map.lattice.columns;
  }
  map.lattice.side = 1.0;
  for (std::string row; lines >> row;)
    for (const char cell : row)
      map.costs.push_back(cell == '.' || cell == 'G' || cell == 'S' ? nav::kPlainCost : std::uint16_t{0});
  return map;
}

inline std::vector<GameQuery> read_game_queries(const std::string& text) {
  std::vector<GameQuery> queries;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string bucket, map;
    int columns = 0, rows = 0;
    GameQuery query{};
    if (words >> bucket >> map >> columns >> rows >> query.start.column >> query.start.row >>
        query.goal.column >> query.goal.row >> query.shortest)
      queries.push_back(query);
  }
  return queries;
}

}  // namespace orca::test
