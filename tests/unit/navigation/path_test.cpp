// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/path.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "orca/base/random.hpp"

using namespace orca::nav;
using orca::Vec2;

TEST_CASE("places on a path are named by the way from its start", "[navigation]") {
  const std::array points{Vec2{0.0, 0.0}, Vec2{2.0, 0.0}, Vec2{2.0, 0.0}, Vec2{2.0, 1.0}};
  const Path path(points);
  CHECK(path.points().size() == 3);
  CHECK(path.length() == 3.0);
  CHECK(path.at(2.5) == Vec2{2.0, 0.5});
  CHECK(path.at(-1.0) == Vec2{0.0, 0.0});
  CHECK(path.at(9.0) == Vec2{2.0, 1.0});
  CHECK(std::abs(path.heading(2.5) - std::numbers::pi / 2) < 1e-12);
  CHECK(path.nearest({1.2, 0.4}, 0.0, 3.0) == Approx(1.2));
  CHECK(path.nearest({1.2, 0.4}, 1.5, 3.0) == Approx(1.5));
}

TEST_CASE("a path may be a single point", "[navigation]") {
  const std::array points{Vec2{1.0, 2.0}};
  const Path path(points);
  CHECK(path.length() == 0.0);
  CHECK(path.at(0.5) == points[0]);
  CHECK(path.nearest({5.0, 5.0}, 0.0, 0.0) == 0.0);
}

TEST_CASE("the nearest place is not farther than any other that is tried", "[navigation]") {
  orca::RandomStream random(9, "test", "paths");
  for (int i = 0; i < 100; ++i) {
    std::vector<Vec2> points;
    for (int k = 0; k < 6; ++k) points.push_back({random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)});
    const Path path(points);
    const Vec2 here{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    const double found = norm(path.at(path.nearest(here, 0.0, path.length())) - here);
    for (double along = 0.0; along <= path.length(); along += 0.05)
      CHECK(norm(path.at(along) - here) >= found - 1e-9);
  }
}

TEST_CASE(
    "straight lines are never dearer than the way of cells that they replace, and lead through free cells "
    "only",
    "[navigation]") {
  orca::RandomStream random(10, "test", "fields");
  GridSearch search;
  for (int i = 0; i < 100; ++i) {
    const Lattice lattice{{}, 0.1, 30, 30};
    std::vector<std::uint16_t> costs(lattice.size());
    for (std::uint16_t& cost : costs) cost = random.chance(0.15) ? 0 : kPlainCost;
    costs[0] = costs.back() = kPlainCost;
    const CellWay way = search(lattice, costs, {0, 0}, {29, 29});
    const std::vector<Vec2> line = straightened(lattice, costs, way);
    double sum = 0.0;
    for (std::size_t k = 1; k < line.size(); ++k) sum += cost_of_line(lattice, costs, line[k - 1], line[k]);
    CAPTURE(i);
    CHECK(line.front() == lattice.middle_of(way.cells.front()));
    CHECK(line.back() == lattice.middle_of(way.cells.back()));
    // A diagonal step costs 7 where its length says 5 times the root of 2.
    CHECK(sum <= 1.011 * way.cost);
    CHECK(line.size() <= way.cells.size());
  }
}

TEST_CASE("rounding keeps the ends, shortens the way and enters no cell that is not passable",
          "[navigation]") {
  const Lattice lattice{{}, 0.1, 30, 30};
  std::vector<std::uint16_t> costs(lattice.size(), kPlainCost);
  for (int column = 0; column < 15; ++column) costs[lattice.index({column, 15})] = 0;
  const std::array line{Vec2{0.25, 0.25}, Vec2{1.65, 1.55}, Vec2{0.25, 2.55}};
  const Path path = rounded(lattice, costs, line, 0.1, 20);
  CHECK(path.at(0.0) == line[0]);
  CHECK(path.at(path.length()) == line[2]);
  CHECK(path.length() < Path(line).length());
  for (const Vec2 point : path.points()) CHECK(costs[lattice.index(lattice.cell_at(point))] != 0);
}
