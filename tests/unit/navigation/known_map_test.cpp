// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/known_map.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "grids.hpp"

using namespace orca;
using namespace orca::nav;

namespace {

// A slanting wall through an empty floor.
const test::Walls kSlant{{{0.5, 1.0}, {5.5, 2.3}}};
FloorGrid slant() { return test::grid_of(kSlant, {0.0, 0.0}, {6.0, 4.0}); }

}  // namespace

TEST_CASE("the surfaces of a drawn wall lie on it and face both sides", "[navigation]") {
  const Vec2 along = 1.0 / norm(Vec2{5.0, 1.3}) * Vec2{5.0, 1.3};
  const Vec2 across{-along.y, along.x};
  int up = 0;
  int down = 0;
  for (const SurfacePoint& point : surface_of(slant())) {
    if (point.at.x < 0.9 || point.at.x > 5.1) continue;  // the ends of the wall are corners
    CHECK(std::fabs(dot(point.at - Vec2{0.5, 1.0}, across)) < 0.02);
    REQUIRE(norm(point.normal) == Approx(1.0));
    CHECK(std::fabs(dot(point.normal, across)) > std::cos(0.12));
    ++(dot(point.normal, across) > 0.0 ? up : down);
  }
  CHECK(up > 60);
  CHECK(down > 60);
}

TEST_CASE("a surface whose other side is not known faces the known one", "[navigation]") {
  FloorGrid grid = slant();
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const Vec2 at = grid.lattice.middle_of(grid.lattice.cell_of(i));
    if (grid.cells[i] == 0 && at.y > 1.0 + 0.26 * (at.x - 0.5)) grid.cells[i] = FloorGrid::kUnknown;
  }
  int faced = 0;
  for (const SurfacePoint& point : surface_of(grid)) {
    if (point.at.x < 0.9 || point.at.x > 5.1) continue;
    CHECK(point.normal.y < 0.0);
    ++faced;
  }
  CHECK(faced > 60);
}

TEST_CASE("a cell of 50 to 100 per cent is occupied, one above not known", "[navigation]") {
  const FloorGrid grid{{{0.0, 0.0}, 0.05, 6, 1}, {0, 49, 50, 100, 101, 254}};
  const auto occupied = [&](int column) { return grid.occupied({column, 0}); };
  const auto free = [&](int column) { return grid.free({column, 0}); };
  CHECK((free(0) && free(1)));
  CHECK((occupied(2) && occupied(3)));
  CHECK_FALSE((occupied(4) || free(4)));
  CHECK_FALSE((occupied(5) || free(5)));
}

TEST_CASE("a map says how far one sees, and where it does not know", "[navigation]") {
  FloorGrid grid = test::two_rooms_grid();
  for (std::size_t i = 0; i < grid.cells.size(); ++i)
    if (norm(grid.lattice.middle_of(grid.lattice.cell_of(i)) - Vec2{3.0, 1.0}) < 0.3)
      grid.cells[i] = FloorGrid::kUnknown;
  const KnownMap map(grid);
  const Sight wall = map.look({3.0, 2.0}, {1.0, 0.0}, 20.0);
  CHECK(wall.end == Sight::End::wall);
  CHECK(wall.range == Approx(2.0).margin(0.08));
  CHECK(map.look({3.0, 3.0}, {1.0, 0.0}, 20.0).range == Approx(7.0).margin(0.08));  // through the door
  CHECK(map.look({3.0, 2.0}, {1.0, 0.0}, 1.5).end == Sight::End::nothing);
  CHECK(map.look({3.02, 1.6}, {0.0, -1.0}, 20.0).end == Sight::End::unknown);
  CHECK(map.look({-5.0, 3.0}, {1.0, 0.0}, 20.0).end == Sight::End::unknown);
  CHECK(map.distance({2.9, 2.3}) == Approx(KnownMap::kReach));
  CHECK(map.distance({3.0, 0.52}) == Approx(0.5).margin(0.05));
}

TEST_CASE("a map explains a scan but for what stands in front of it or behind", "[navigation]") {
  RandomStream random(1, "test", "scans");
  const KnownMap map(test::two_rooms_grid());
  const Pose2 here{3.0, 2.0, 0.4};
  std::vector<SurfacePoint> scan = test::scan_of(test::two_rooms(), here, 0.01, random);
  const auto count = static_cast<double>(scan.size());
  CHECK(map.explain(scan, {}, here).share() > 0.99);
  for (std::size_t i = 0; i < scan.size() / 2; ++i) scan[i].at = 0.5 * scan[i].at;
  const Explanation people = map.explain(scan, {}, here);
  CHECK(people.shorts == Approx(0.5 * count).margin(0.03 * count));
  CHECK(people.share() == Approx(2.0 / 3.0).margin(0.03));
  for (std::size_t i = 0; i < scan.size() / 2; ++i) scan[i].at = 2.4 * scan[i].at;
  CHECK(map.explain(scan, {}, here).longs > 0.3 * count);
  CHECK(map.explain({}, {}, here).share() == 0.0);
  CHECK(people.fit_of_room > people.fit);  // What is near hides little of the room.
  CHECK(people.fit_of_room <= 1.0);
  for (SurfacePoint& point : scan) point.at = 0.3 / norm(point.at) * point.at;
  const Explanation hidden = map.explain(scan, {}, here);
  CHECK(hidden.fit_of_room == hidden.fit);
  CHECK(hidden.fit < 0.2);
}
