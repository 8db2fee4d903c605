// SPDX-License-Identifier: GPL-3.0-or-later
// Maps as they come: whole ones, and parts that have changed.
#include "orca/planning/floor.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <vector>

using namespace orca;
using orca::planning::Floor;

namespace {

idl::OccupancyGrid grid(const std::string& name, Vec2 corner, std::uint32_t columns,
                        const std::vector<std::uint8_t>& cells) {
  idl::OccupancyGrid grid;
  grid.name(name);
  grid.corner().x(corner.x);
  grid.corner().y(corner.y);
  grid.resolution(0.5);
  grid.columns(columns);
  grid.rows(static_cast<std::uint32_t>(cells.size()) / columns);
  grid.cells(cells);
  return grid;
}

constexpr std::uint8_t kUnknown = nav::FloorGrid::kUnknown;

}  // namespace

TEST_CASE("a part of a map that has changed takes its place in it", "[planning]") {
  Floor floor;
  REQUIRE(floor.take(grid("office", {1.0, 2.0}, 3, {0, 0, 0, 0, 0, 0})).ok());
  REQUIRE(floor.take(grid("office", {1.5, 2.5}, 2, {100, 50})).ok());
  CHECK(floor.grid().cells == std::vector<std::uint8_t>{0, 0, 0, 0, 100, 50});
}

TEST_CASE("a part beyond the edge is another map, unless the map is one that grows", "[planning]") {
  const auto first = grid("made", {1.0, 2.0}, 2, {1, 2, 3, 4});
  const auto beyond = grid("made", {0.5, 3.0}, 1, {9});
  Floor fixed;
  REQUIRE(fixed.take(first).ok());
  REQUIRE(fixed.take(beyond).ok());
  CHECK(fixed.grid().cells == std::vector<std::uint8_t>{9});

  Floor grows(Floor::kMostToPlan, Floor::Edge::grows);
  REQUIRE(grows.take(first).ok());
  REQUIRE(grows.take(beyond).ok());
  CHECK(grows.grid().lattice.corner == Vec2{0.5, 2.0});
  CHECK(grows.grid().lattice.columns == 3);
  CHECK(grows.grid().cells ==
        std::vector<std::uint8_t>{kUnknown, 1, 2, kUnknown, 3, 4, 9, kUnknown, kUnknown});
  REQUIRE(grows.take(grid("another", {0.0, 0.0}, 1, {7})).ok());
  CHECK(grows.grid().cells == std::vector<std::uint8_t>{7});
}
