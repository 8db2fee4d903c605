// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/occupancy_map.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/navigation/beams.hpp"

using namespace orca::nav;
using orca::Vec2;

namespace {

OccupancyMap map_around(Vec2 place) {
  OccupancyMap map(0.05, 8.0);
  map.reset(place);
  return map;
}

void see(OccupancyMap& map, Vec2 from, Vec2 to, bool echo, int times = 1) {
  const std::array beams{Beam{from, to, echo}};
  for (int i = 0; i < times; ++i) map.see(beams);
}

bool occupied(const OccupancyMap& map, Vec2 place) { return map.occupied(map.lattice().cell_at(place)); }
bool known(const OccupancyMap& map, Vec2 place) {
  return map.known(map.lattice().index(map.lattice().cell_at(place)));
}

}  // namespace

TEST_CASE("an echo makes its cell occupied and the cells before it free; what lies behind stays unknown",
          "[navigation]") {
  OccupancyMap map = map_around({});
  see(map, {0.0, 0.0}, {2.02, 1.01}, true);
  CHECK(occupied(map, {2.02, 1.01}));
  CHECK(known(map, {1.0, 0.5}));
  CHECK_FALSE(occupied(map, {1.0, 0.5}));
  CHECK_FALSE(known(map, {2.2, 1.1}));
}

TEST_CASE("what has gone is cleared by looking through its place, but not by a beam that meets nothing",
          "[navigation]") {
  OccupancyMap map = map_around({});
  see(map, {}, {1.02, 0.02}, true, 3);
  see(map, {}, {3.0, 0.02}, false, 50);
  CHECK(occupied(map, {1.02, 0.02}));
  see(map, {}, {3.0, 0.02}, true, 12);
  CHECK_FALSE(occupied(map, {1.02, 0.02}));
}

TEST_CASE("many beams of one scan count once in a cell, and an echo there counts more than those that pass",
          "[navigation]") {
  OccupancyMap map = map_around({});
  std::vector<Beam> scan(40, Beam{{}, {2.02, 0.02}, true});
  scan.push_back({{}, {1.02, 0.02}, true});
  map.see(scan);
  CHECK(occupied(map, {1.02, 0.02}));
  see(map, {}, {2.02, 0.02}, true, 1);
  CHECK(occupied(map, {1.02, 0.02}));
  see(map, {}, {2.02, 0.02}, true, 1);
  CHECK_FALSE(occupied(map, {1.02, 0.02}));
}

TEST_CASE("the point of a cell is the mean of its echoes, so noise averages out", "[navigation]") {
  orca::RandomStream random(2, "test", "noise");
  OccupancyMap map = map_around({});
  for (int i = 0; i < 200; ++i) see(map, {}, {1.025 + random.uniform(-0.02, 0.02), 0.025}, true);
  const Vec2 point = map.point(map.lattice().cell_at({1.025, 0.025}));
  CHECK(std::abs(point.x - 1.025) < 0.012);
  CHECK(std::abs(point.y - 0.025) < 0.002);
}

TEST_CASE("the window follows the robot by whole cells and keeps what stays within", "[navigation]") {
  OccupancyMap map = map_around({});
  see(map, {}, {1.02, 0.02}, true);
  map.follow({1.9, 0.0});
  CHECK(map.lattice().corner == Vec2{-4.0, -4.0});  // not yet
  map.follow({2.5, 0.0});
  CHECK(std::abs(map.lattice().corner.x - -1.5) < 0.051);
  CHECK(occupied(map, {1.02, 0.02}));
  map.follow({9.0, 0.0});
  CHECK_FALSE(map.lattice().holds(map.lattice().cell_at({1.02, 0.02})));
}

TEST_CASE("recovery forgets what is far away", "[navigation]") {
  OccupancyMap map = map_around({});
  see(map, {}, {1.02, 0.02}, true);
  see(map, {}, {-3.02, 0.02}, true);
  map.forget_beyond({}, 1.5);
  CHECK(occupied(map, {1.02, 0.02}));
  CHECK_FALSE(known(map, {-3.02, 0.02}));
}

TEST_CASE("a map that is doubted frees what a scan looks through without an echo, but for what the scan sees",
          "[navigation]") {
  OccupancyMap map(0.05, 16.0);
  const std::vector<Beam> before{{{}, {1.02, 0.02}, true}, {{}, {0.02, 1.02}, true}};
  map.see(before);
  const std::vector<Beam> now{{{}, {5.02, 0.1}, false}, {{}, {0.02, 1.02}, true}};
  map.see(now);
  CHECK(occupied(map, {1.02, 0.02}));  // No echo is no reason,
  map.clear_along(now);
  CHECK_FALSE(occupied(map, {1.02, 0.02}));  // unless nothing leads on.
  CHECK(occupied(map, {0.02, 1.02}));
}

TEST_CASE("a place that is held is occupied until scans have looked through it often enough",
          "[navigation]") {
  OccupancyMap map(0.05, 16.0);
  const std::vector<Beam> scan{{{}, {3.02, 0.02}, true}};
  for (int i = 0; i < 10; ++i) map.see(scan);
  map.hold({1.02, 0.02});
  CHECK(occupied(map, {1.02, 0.02}));
  map.see(scan);
  CHECK(occupied(map, {1.02, 0.02}));
  for (int i = 0; i < 10; ++i) map.see(scan);
  CHECK_FALSE(occupied(map, {1.02, 0.02}));
  map.hold({100.0, 0.0});  // outside of the window
}

TEST_CASE("a line visits neighbouring cells from one end to the other, whatever its direction",
          "[navigation]") {
  orca::RandomStream random(5, "test", "lines");
  const Lattice lattice{{-5.0, -5.0}, 0.1, 100, 100};
  for (int i = 0; i < 500; ++i) {
    const Vec2 from{random.uniform(-4.9, 4.9), random.uniform(-4.9, 4.9)};
    const Vec2 to{i % 7 == 0 ? from.x : random.uniform(-4.9, 4.9),
                  i % 11 == 0 ? from.y : random.uniform(-4.9, 4.9)};
    std::vector<Cell> cells;
    CHECK(walk_line(lattice, from, to, [&](Cell cell) { return cells.push_back(cell), true; }));
    CAPTURE(i);
    REQUIRE(cells.front() == lattice.cell_at(from));
    REQUIRE(cells.back() == lattice.cell_at(to));
    const Vec2 way = to - from;
    for (std::size_t k = 1; k < cells.size(); ++k) {
      CHECK(std::abs(cells[k].column - cells[k - 1].column) + std::abs(cells[k].row - cells[k - 1].row) == 1);
      const double off = orca::cross(way, lattice.middle_of(cells[k]) - from) / std::max(1e-9, norm(way));
      CHECK(std::abs(off) < 0.0708);  // half a cell's diagonal
    }
  }
}

TEST_CASE("each beam of a sweep starts where the sensor was at its instant", "[navigation]") {
  const std::vector<double> ranges{1.0, 1.0, 9.0, 0.01};
  std::vector<Beam> beams;
  beams_of({ranges, 0.05, 8.0, 0.0, 0.0, {0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}}, 5.0, beams);
  REQUIRE(beams.size() == 4);
  CHECK(std::abs(beams[1].from.x - 0.1) < 1e-12);
  CHECK(std::abs(beams[1].to.x - 1.1) < 1e-12);
  CHECK(beams[1].echo);
  CHECK_FALSE(beams[2].echo);
  CHECK(std::abs(beams[2].to.x - 5.2) < 1e-12);  // nothing within the range that counts
  CHECK(beams[3].echo);
  CHECK(std::abs(beams[3].to.x - 0.35) < 1e-12);  // too near to be measured
}
