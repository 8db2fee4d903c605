// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/drawn_map.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "walls.hpp"

using namespace orca;
using namespace orca::nav;

namespace {

constexpr int kFree = 0;
constexpr int kOccupied = 100;
constexpr int kUnknown = 255;
constexpr std::size_t kAll = 1'000'000;
constexpr double kSide = 0.05;

SlamNode node_at(const Pose2& X_MR, std::vector<Vec2> points, Vec2 sensor = {}) {
  SlamNode node;
  node.X_MR = X_MR;
  node.sensor = sensor;
  for (const Vec2 point : points) node.scan.push_back({point, {}});
  return node;
}

int cell_of(const MapPart& part, Vec2 place) {
  const Cell cell = part.lattice.cell_at(place);
  return part.lattice.holds(cell) ? part.cells[part.lattice.index(cell)] : kUnknown;
}

MapPart drawn(std::span<const SlamNode> nodes) {
  DrawnMap map(kSide);
  CHECK(map.draw(nodes, kAll));
  return map.whole();
}

bool same(const MapPart& a, const MapPart& b) {
  return a.lattice.corner.x == b.lattice.corner.x && a.lattice.corner.y == b.lattice.corner.y &&
         a.cells == b.cells;
}

// Nodes on a straight line through a room.
std::vector<SlamNode> through_room() {
  RandomStream random(5, "test", "room");
  const test::Walls room = test::box({-3.0, -2.0}, {5.0, 2.0});
  std::vector<SlamNode> nodes;
  for (int i = 0; i < 20; ++i) {
    const Pose2 here{0.2 * i - 2.0, 0.1, 0.0};
    SlamNode node = node_at(here, {});
    node.scan = test::scan_of(room, here, 0.01, random);
    nodes.push_back(node);
  }
  return nodes;
}

}  // namespace

TEST_CASE("what lies between sensor and echo is free, the echo's cell is occupied, all else is not known",
          "[navigation][map]") {
  const std::vector nodes{node_at({1.025, 1.0, std::numbers::pi / 2.0}, {{2.02, 0.0}}, {0.5, 0.0})};
  const MapPart map = drawn(nodes);
  CHECK(cell_of(map, {1.025, 1.42}) == kUnknown);  // behind the sensor
  CHECK(cell_of(map, {1.025, 1.52}) == kFree);
  CHECK(cell_of(map, {1.025, 2.92}) == kFree);
  CHECK(cell_of(map, {1.025, 3.02}) == kOccupied);
  CHECK(cell_of(map, {1.025, 3.12}) == kUnknown);
  CHECK(std::ranges::count(map.cells, kOccupied) == 1);
}

TEST_CASE("a cell is occupied while more than a third of the nodes that count there had an echo",
          "[navigation][map]") {
  const SlamNode echo = node_at({0.025, 0.025, 0.0}, {{1.0, 0.0}});
  const SlamNode through = node_at({0.025, 0.025, 0.0}, {{2.0, 0.0}});
  std::vector nodes{echo, through};
  CHECK(cell_of(drawn(nodes), {1.025, 0.025}) == kOccupied);
  nodes.push_back(through);
  CHECK(cell_of(drawn(nodes), {1.025, 0.025}) == kFree);
  nodes.push_back(echo);
  CHECK(cell_of(drawn(nodes), {1.025, 0.025}) == kOccupied);
}

TEST_CASE("a node counts once in a cell, however many of its beams pass there", "[navigation][map]") {
  std::vector nodes{node_at({0.025, 0.025, 0.0}, {{1.0, 0.0}, {1.5, 0.0}, {1.5, 0.001}, {1.5, 0.002}})};
  CHECK(cell_of(drawn(nodes), {1.025, 0.025}) == kOccupied);
}

TEST_CASE("a map whose nodes have moved is the map of the nodes where they are now", "[navigation][map]") {
  std::vector<SlamNode> nodes = through_room();
  DrawnMap map(kSide);
  CHECK(map.draw(nodes, kAll));
  const MapPart before = map.whole();
  for (std::size_t i = 5; i < nodes.size(); ++i) nodes[i].X_MR = Pose2{0.3, -0.4, 0.1} * nodes[i].X_MR;
  CHECK(map.draw(nodes, kAll));
  const MapPart bent = map.whole();
  CHECK_FALSE(same(bent, before));
  // Tiles that nothing is known of any more stay, so cells are compared where the other map has them.
  const MapPart anew = drawn(nodes);
  for (std::size_t i = 0; i < bent.cells.size(); ++i) {
    const Vec2 place = bent.lattice.middle_of(bent.lattice.cell_of(i));
    if (bent.cells[i] != cell_of(anew, place)) FAIL("cell " << i << " at " << place.x << ", " << place.y);
  }
  CHECK(std::ranges::count(anew.cells, kOccupied) == std::ranges::count(bent.cells, kOccupied));
}

TEST_CASE("the order in which nodes are drawn makes no difference", "[navigation][map]") {
  const std::vector<SlamNode> nodes = through_room();
  DrawnMap map(kSide);
  for (std::size_t count = 1; count <= nodes.size(); ++count)
    CHECK(map.draw(std::span(nodes).first(count), kAll));
  CHECK(same(map.whole(), drawn(nodes)));
  DrawnMap slow(kSide);
  int calls = 1;
  while (!slow.draw(nodes, 3)) ++calls;
  CHECK(calls == 7);
  CHECK(same(slow.whole(), drawn(nodes)));
}

TEST_CASE("news are the tiles in which cells have changed, and each is reported once", "[navigation][map]") {
  constexpr double kTile = 64 * kSide;
  std::vector nodes{node_at({0.1, 0.1, 0.0}, {{1.0, 0.0}})};
  DrawnMap map(kSide);
  CHECK_FALSE(map.news());
  map.draw(nodes, kAll);
  auto news = map.news();
  REQUIRE(news);
  CHECK(news->lattice.columns == 64);
  CHECK(news->lattice.rows == 64);
  CHECK(news->lattice.corner.x == 0.0);
  CHECK_FALSE(map.news());

  nodes.push_back(node_at({-0.1 - kTile, 0.1, 0.0}, {{1.0, 0.0}}));
  map.draw(nodes, kAll);
  news = map.news();
  REQUIRE(news);
  CHECK(news->lattice.corner.x == Approx(-2.0 * kTile));
  CHECK(news->lattice.columns == 128);  // The node's own tile, and that of its echo.
  CHECK(same(map.whole(), drawn(nodes)));

  nodes.push_back(nodes.back());  // Seen once more: no cell says anything else.
  map.draw(nodes, kAll);
  CHECK_FALSE(map.news());

  nodes[0].X_MR.x += 0.02;  // Less than half a cell.
  map.draw(nodes, kAll);
  CHECK_FALSE(map.news());
  nodes[0].X_MR.y += 1.0;
  map.draw(nodes, kAll);
  news = map.news();
  REQUIRE(news);
  CHECK(news->lattice.columns == 64);
}

TEST_CASE("the map of a room has its walls where they are, and nothing behind them", "[navigation][map]") {
  const MapPart map = drawn(through_room());
  const auto off_wall = [](Vec2 p) {  // [m] from the walls, positive within the room
    return std::min({p.x + 3.0, 5.0 - p.x, p.y + 2.0, 2.0 - p.y});
  };
  int occupied = 0, near = 0, free = 0, inside = 0;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const double off = off_wall(map.lattice.middle_of(map.lattice.cell_of(i)));
    occupied += map.cells[i] == kOccupied ? 1 : 0;
    near += map.cells[i] == kOccupied && std::fabs(off) < 0.075 ? 1 : 0;
    free += map.cells[i] == kFree ? 1 : 0;
    inside += map.cells[i] == kFree && off > -0.075 ? 1 : 0;
  }
  CHECK(occupied > 200);
  CHECK(near == occupied);
  CHECK(free > 7000);  // of 12800 cells of the room: the laser looks ahead from its left end
  CHECK(inside == free);
}
