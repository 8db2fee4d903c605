// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/sim/occupancy.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <string>

#include "orca/base/random.hpp"

using namespace orca;
using namespace orca::sim;

namespace {

Obstacle solid(Shape shape, double height = 1.0, double bottom = 0.0) {
  return {.name = "solid", .shape = std::move(shape), .height = height, .bottom = bottom};
}

// Returns the rows of the map, the upper one first, with # for covered cells.
std::string drawn(const Occupancy& grid) {
  std::string text;
  for (std::size_t row = grid.rows; row-- > 0;) {
    for (std::size_t column = 0; column < grid.columns; ++column)
      text += grid.cells[row * grid.columns + column] ? '#' : '.';
    text += '\n';
  }
  return text;
}

// A world from (-1, 2) to (4, 6), because of its two places.
WorldModel world_of(std::vector<Obstacle> obstacles) {
  return {.name = "test",
          .obstacles = std::move(obstacles),
          .places = {{"low", {-1.0, 2.0, 0.0}}, {"high", {4.0, 6.0, 0.0}}}};
}

std::string map_of(Obstacle obstacle, double height = 0.5) {
  return drawn(occupancy_of(world_of({std::move(obstacle)}), 1.0, height).value());
}

}  // namespace

TEST_CASE("a map covers the world from its lower left corner", "[sim][occupancy]") {
  const Occupancy grid = occupancy_of(world_of({}), 0.4, 1.0).value();
  CHECK(grid.corner == Vec2{-1.0, 2.0});
  CHECK(grid.columns == 13);  // 5 m
  CHECK(grid.rows == 10);     // 4 m
  CHECK(grid.cells == std::vector<bool>(130, false));
}

TEST_CASE("a cell that holds a part of an obstacle is covered, one that it only touches is not",
          "[sim][occupancy]") {
  CHECK(map_of(solid(Box{{1.0, 4.0, 0.0}, {1.0, 1.0}})) == ".....\n.##..\n.##..\n.....\n");
  CHECK(map_of(solid(Box{{1.05, 4.0, 0.0}, {1.0, 1.0}})) == ".....\n.###.\n.###.\n.....\n");
  CHECK(map_of(solid(Box{{0.6, 4.0, 0.0}, {0.1, 2.0}})) == ".#...\n.#...\n.#...\n.#...\n");
  CHECK(map_of(solid(Circle{{1.5, 3.5}, 0.1})) == ".....\n.....\n..#..\n.....\n");
  CHECK(map_of(solid(Circle{{2.0, 4.0}, 0.3})) == ".....\n..##.\n..##.\n.....\n");
}

TEST_CASE("an outline with a hole is covered between its boundaries", "[sim][occupancy]") {
  Outline ring = outline_of({{-1.0, 2.0}, {4.0, 2.0}, {4.0, 6.0}, {-1.0, 6.0}});
  for (const Segment& edge : outline_of({{0.0, 3.0}, {3.0, 3.0}, {3.0, 5.0}, {0.0, 5.0}}).edges)
    ring.edges.push_back({edge.b, edge.a});
  CHECK(map_of(solid(ring)) == "#####\n#...#\n#...#\n#####\n");
}

TEST_CASE("only what stands between the floor and the height counts", "[sim][occupancy]") {
  const Box table{{1.0, 4.0, 0.0}, {1.0, 1.0}};
  const std::string empty = ".....\n.....\n.....\n.....\n";
  CHECK(map_of(solid(table, 0.8, 0.7), 0.5) == empty);
  CHECK(map_of(solid(table, 0.8, 0.7), 0.75) != empty);
}

// The rows are filled in another way than overlap() compares solids: both must agree on any box and triangle.
TEST_CASE("a map says of each cell what a comparison of solids says", "[sim][occupancy]") {
  RandomStream random(7, "test", "occupancy");
  const auto somewhere = [&] { return Vec2{random.uniform(-1.0, 4.0), random.uniform(2.0, 6.0)}; };
  for (int lap = 0; lap < 100; ++lap) {
    const Vec2 at = somewhere();
    Shape shape = Box{{at.x, at.y, random.uniform(-3.0, 3.0)}, {random.uniform(0.01, 2.0), 0.3}};
    if (lap % 2 == 0) shape = outline_of({somewhere(), somewhere(), somewhere()});
    const WorldModel world = world_of({solid(shape)});
    const Occupancy grid = occupancy_of(world, 0.25, 0.5).value();
    std::size_t different = 0;
    for (std::size_t k = 0; k < grid.cells.size(); ++k) {
      const Vec2 middle = grid.corner + 0.25 * Vec2{static_cast<double>(k % grid.columns) + 0.5,
                                                    static_cast<double>(k / grid.columns) + 0.5};
      const Box cell{{middle.x, middle.y, 0.0}, {0.125, 0.125}};
      different += grid.cells[k] != overlap(world.obstacles[0], cell, 0.0, 0.5) ? 1 : 0;
    }
    CAPTURE(lap);
    CHECK(different == 0);
  }
}

TEST_CASE("a map that would be too large is refused", "[sim][occupancy]") {
  CHECK_FALSE(occupancy_of(world_of({}), 0.001, 1.0));
  CHECK_FALSE(occupancy_of(world_of({}), 0.0, 1.0));
  CHECK_FALSE(occupancy_of(world_of({}), std::numeric_limits<double>::quiet_NaN(), 1.0));
}
