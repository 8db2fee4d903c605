// SPDX-License-Identifier: GPL-3.0-or-later
// The rooms and doors that a map suggests.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mapping/rooms.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/planning/ways_file.hpp"
#include "orca/sim/occupancy.hpp"
#include "orca/sim/world_file.hpp"

using namespace orca;
using namespace orca::orcactl::mapping;
using Catch::Contains;
using std::numbers::pi;

namespace {

constexpr double kCell = 0.05;  // [m]

/// A free floor without walls, from the origin.
nav::FloorGrid floor_of(double length, double width) {
  nav::FloorGrid grid;
  grid.lattice = {{0.0, 0.0},
                  kCell,
                  static_cast<int>(std::lround(length / kCell)),
                  static_cast<int>(std::lround(width / kCell))};
  grid.cells.resize(grid.lattice.size());
  return grid;
}

void build(nav::FloorGrid& grid, Vec2 low, Vec2 high) {
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const Vec2 middle = grid.lattice.middle_of(grid.lattice.cell_of(i));
    if (middle.x > low.x && middle.x < high.x && middle.y > low.y && middle.y < high.y)
      grid.cells[i] = nav::FloorGrid::kMost;
  }
}

/// A room of 4 m by 3 m and one of 6 m by 3 m, with a wall at x = 4 m between them that is open from y = 1 m to `top`.
nav::FloorGrid two_rooms(double top) {
  nav::FloorGrid grid = floor_of(10.2, 3.2);
  build(grid, {0.0, 0.0}, {10.2, 0.1});
  build(grid, {0.0, 3.1}, {10.2, 3.2});
  build(grid, {0.0, 0.0}, {0.1, 3.2});
  build(grid, {10.1, 0.0}, {10.2, 3.2});
  build(grid, {4.0, 0.0}, {4.1, 1.0});
  build(grid, {4.0, top}, {4.1, 3.2});
  return grid;
}

planning::Ways read(const std::string& text) {
  xml::Diagnostics diagnostics;
  const auto ways = planning::read_ways_text(text, "proposal.xml", diagnostics);
  INFO(diagnostics.text() << text);
  REQUIRE(ways);
  return *ways;
}

}  // namespace

TEST_CASE("two rooms meet at the door between them", "[orcactl][ways]") {
  const Division division = divide(two_rooms(1.9)).value();
  REQUIRE(division.rooms.size() == 2);
  CHECK(division.rooms[0].area == Approx(3.9 * 3.0).margin(0.3));
  CHECK(division.rooms[1].area == Approx(6.0 * 3.0).margin(0.3));
  REQUIRE(division.passages.size() == 1);
  const Passage& door = division.passages[0];
  CHECK(door.middle.x == Approx(4.05).margin(0.1));
  CHECK(door.middle.y == Approx(1.45).margin(0.05));
  CHECK(door.direction == Approx(0.0).margin(0.1));
  CHECK(door.width == Approx(0.9).margin(0.06));
  CHECK(division.legs.empty());
}

TEST_CASE("a wide opening is no door, and neither is a slit", "[orcactl][ways]") {
  CHECK(divide(two_rooms(2.6)).value().rooms.size() == 1);
  CHECK(divide(two_rooms(1.4)).value().passages.empty());
}

TEST_CASE("furniture that stands free makes no doors", "[orcactl][ways]") {
  nav::FloorGrid grid = two_rooms(1.9);
  build(grid, {6.5, 1.1}, {8.5, 2.1});
  const Division division = divide(grid).value();
  CHECK(division.rooms.size() == 2);
  CHECK(division.passages.size() == 1);
}

TEST_CASE("a proposal is a file of ways, in the frame of the goals, with legs from door to door",
          "[orcactl][ways]") {
  nav::FloorGrid grid = two_rooms(1.9);
  build(grid, {7.0, 0.0}, {7.1, 1.0});  // a wall with a door of 0.9 m, and behind it one from the north
  build(grid, {7.0, 1.9}, {7.1, 3.2});
  const Division division = divide(grid).value();
  REQUIRE(division.rooms.size() == 3);
  REQUIRE(division.passages.size() == 2);
  REQUIRE(division.legs.size() == 1);
  CHECK(division.legs[0].length == Approx(3.0).margin(0.15));
  const planning::Ways ways = read(ways_text(division, {0.0, 0.0, 0.5 * pi}, "flat"));
  CHECK(ways.name == "flat");
  REQUIRE(ways.points.size() == 2);
  CHECK(ways.points[0].place.x == Approx(-1.45).margin(0.05));
  CHECK(ways.points[0].place.y == Approx(4.05).margin(0.1));
  CHECK(ways.points[0].door->direction == Approx(0.5 * pi).margin(0.1));
  CHECK(ways.legs.size() == 1);
}

TEST_CASE("the doors of the office are found in its map, and not many others", "[orcactl][ways]") {
  const planning::Ways known = planning::read_ways(ORCA_SOURCE_DIR "/sim/ways/office.xml").value();
  std::vector<std::string> warnings;
  const auto world = sim::read_world(ORCA_SOURCE_DIR "/sim/worlds/office.xml", warnings);
  REQUIRE(world);
  const auto drawn = sim::occupancy_of(*world, kCell, 1.0);
  REQUIRE(drawn);
  idl::OccupancyGrid map;
  sim::fill(map, *drawn);
  nav::FloorGrid grid;
  grid.lattice = {{map.corner().x(), map.corner().y()},
                  map.resolution(),
                  static_cast<int>(map.columns()),
                  static_cast<int>(map.rows())};
  grid.cells.assign(map.cells().begin(), map.cells().end());
  const planning::Ways found = read(ways_text(divide(grid).value(), {}, "office"));
  for (const planning::WayPoint& door : known.points) {
    CAPTURE(door.name);
    const auto is_it = [&](const planning::WayPoint& other) { return norm(other.place - door.place) < 0.2; };
    const auto match = std::ranges::find_if(found.points, is_it);
    REQUIRE(match != found.points.end());
    CHECK(match->door->width == Approx(door.door->width).margin(0.11));
    CHECK(std::fabs(std::cos(match->door->direction - door.door->direction)) > 0.98);
  }
  CHECK(found.points.size() <= known.points.size() + 3);
}

TEST_CASE("a map of too many cells is refused", "[orcactl][ways]") {
  nav::FloorGrid grid;
  grid.lattice = {{0.0, 0.0}, kCell, 4096, 4096};
  const auto division = divide(grid);
  REQUIRE_FALSE(division);
  CHECK_THAT(division.error().message, Contains("larger cells"));
}
