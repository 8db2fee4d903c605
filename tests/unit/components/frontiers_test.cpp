// SPDX-License-Identifier: GPL-3.0-or-later
// Borders of what is known, to which a robot that makes a map drives.
#include "explorer/frontiers.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace orca;
using namespace orca::explore;

namespace {

/// A map with a metre in five cells: '.' free, '#' occupied, '?' unknown; the last row is that of least y. The robot is at 'R'.
struct Drawn {
  nav::FloorGrid map{};
  Vec2 robot{};

  explicit Drawn(const std::vector<std::string>& rows) {
    map.lattice = {{0.0, 0.0}, 0.2, static_cast<int>(rows[0].size()), static_cast<int>(rows.size())};
    map.cells.assign(map.lattice.size(), nav::FloorGrid::kUnknown);
    for (int row = 0; row < map.lattice.rows; ++row) {
      const std::string& line = rows[rows.size() - 1 - static_cast<std::size_t>(row)];
      for (int column = 0; column < map.lattice.columns; ++column) {
        const char drawn = line[static_cast<std::size_t>(column)];
        const nav::Cell cell{column, row};
        if (drawn == 'R') robot = map.lattice.middle_of(cell);
        if (drawn == '.' || drawn == 'R') map.cells[map.lattice.index(cell)] = 0;
        if (drawn == '#') map.cells[map.lattice.index(cell)] = 100;
      }
    }
  }
};

}  // namespace

TEST_CASE("a room that is seen all over has no frontier", "[explorer]") {
  const Drawn room({"########", "#......#", "#..R...#", "#......#", "########"});
  CHECK(frontiers(room.map, 0.1, room.robot, 0.2).empty());
}

TEST_CASE("an open end of what is known is a frontier, with its width and the way there", "[explorer]") {
  const Drawn corridor({"###########", "#.........?", "#R........?", "#.........?", "###########"});
  const auto found = frontiers(corridor.map, 0.1, corridor.robot, 0.2);
  REQUIRE(found.size() == 1);
  CHECK(found[0].place.x == Approx(1.9));
  CHECK(found[0].place.y == Approx(0.5));
  CHECK(found[0].width == Approx(0.6));
  CHECK(found[0].way == Approx(1.6));
}

TEST_CASE("of two frontiers the nearer by the way is first, not the one through a wall", "[explorer]") {
  const Drawn ways({"############", "?..........#", "##########.#", "#R.........?", "############"});
  const auto found = frontiers(ways.map, 0.1, ways.robot, 0.2);
  REQUIRE(found.size() == 2);
  CHECK(found[0].place.x == Approx(2.1));
  CHECK(found[1].place.x == Approx(0.3));
  CHECK(found[1].way > 3.0);
}

TEST_CASE("a frontier behind a gap too narrow for the robot, or itself too narrow, is none", "[explorer]") {
  const Drawn gap(
      {"##?????##", "##.....##", "####.####", "#.......#", "#...R...#", "#.......#", "#########"});
  CHECK(frontiers(gap.map, 0.1, gap.robot, 0.2).size() == 1);
  CHECK(frontiers(gap.map, 0.3, gap.robot, 0.2).empty());
  CHECK(frontiers(gap.map, 0.1, gap.robot, 1.2).empty());
}

TEST_CASE("the edge of the map is a frontier, and a robot outside of it has none", "[explorer]") {
  const Drawn edge({"...", ".R.", "..."});
  CHECK(frontiers(edge.map, 0.1, edge.robot, 0.2).size() == 1);
  CHECK(frontiers(edge.map, 0.1, {50.0, 50.0}, 0.2).empty());
}
