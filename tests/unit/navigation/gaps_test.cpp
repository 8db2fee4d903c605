// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/gaps.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/navigation/path_planner.hpp"

using namespace orca::nav;
using orca::Vec2;

namespace {

constexpr Footprint kLong{0.25, 0.2, 0.33};

// A wall along y at x = 2 with a door from `low` to `high`.
OccupancyMap wall_with_door(double low, double high) {
  OccupancyMap map(0.05, 8.0);
  map.reset({2.0, 0.0});
  std::vector<Beam> scan;
  for (double y = low; y > -3.0; y -= 0.02) scan.push_back({{2.0, y}, {2.0, y}, true});
  for (double y = high; y < 3.0; y += 0.02) scan.push_back({{2.0, y}, {2.0, y}, true});
  for (int i = 0; i < 3; ++i) map.see(scan);
  return map;
}

// A corridor along x whose walls a laser has seen with errors of 1 cm, as one does.
OccupancyMap corridor(double half_width, orca::RandomStream& random) {
  OccupancyMap map(0.05, 8.0);
  map.reset({2.0, 0.0});
  for (int i = 0; i < 3; ++i) {
    std::vector<Beam> scan;
    for (double x = -1.5; x < 5.5; x += 0.04)
      for (const double y : {-half_width, half_width}) {
        const Vec2 echo{x, y + random.uniform(-0.01, 0.01)};
        scan.push_back({echo, echo, true});
      }
    map.see(scan);
  }
  return map;
}

double off_axis(const Path& path, double x, double y) {
  return std::abs(path.at(path.nearest({x, y}, 0.0, path.length())).y - y);
}

}  // namespace

TEST_CASE("a door is found with its middle, its width and the direction through it", "[navigation]") {
  orca::RandomStream random(6, "test", "doors");
  for (int i = 0; i < 50; ++i) {
    const double low = random.uniform(-1.0, 0.5);
    const double width = random.uniform(0.45, 0.8);
    const OccupancyMap map = wall_with_door(low, low + width);
    const Vec2 near{random.uniform(1.9, 2.1), low + width * random.uniform(0.3, 0.7)};
    const auto gap = gap_around(map, near, {1.0, 0.3}, 1.0);
    CAPTURE(i, low, width);
    REQUIRE(gap);
    CHECK(norm(gap->middle - Vec2{2.0, low + 0.5 * width}) < 0.03);
    CHECK(std::abs(gap->width - width) < 0.05);
    CHECK(gap->axis.x > 0.99);
  }
}

TEST_CASE("there is no gap beside a single wall", "[navigation]") {
  const OccupancyMap map = wall_with_door(3.0, 3.0);
  CHECK_FALSE(gap_around(map, {1.7, 0.0}, {0.0, 1.0}, 0.6));
}

TEST_CASE("a path that crosses a narrow door askew is lined up with it, and still leads where it led",
          "[navigation]") {
  const OccupancyMap map = wall_with_door(-0.26, 0.26);
  const std::array askew{Vec2{0.5, -1.2}, Vec2{2.0, 0.05}, Vec2{3.5, 1.2}};
  const Path path = lined_up(map, kLong, Path(askew));
  CHECK(norm(path.at(0.0) - askew[0]) < 1e-9);
  CHECK(norm(path.at(path.length()) - askew[2]) < 1e-9);
  for (const double x : {1.7, 1.85, 2.0, 2.15, 2.3}) CHECK(off_axis(path, x, 0.0) < 0.03);
}

TEST_CASE("a path beside the middle of a corridor takes no step aside in which the robot would touch a wall",
          "[navigation]") {
  orca::RandomStream random(7, "test", "corridors");
  for (double half_width = 0.26; half_width < 0.37; half_width += 0.01) {
    const OccupancyMap map = corridor(half_width, random);
    const std::array beside{Vec2{0.0, 0.025}, Vec2{4.0, 0.025}};
    const Path path = lined_up(map, kLong, Path(beside));
    CAPTURE(half_width);
    CHECK(touches_along(map, kLong, path, 0.0, path.length()) < 0.0);
    CHECK(norm(path.at(path.length()) - beside[1]) < 1e-9);
    for (double along = 0.0; along < path.length(); along += 0.02) CHECK(std::abs(path.heading(along)) < 0.3);
  }
}

TEST_CASE("a path through a wide door stays as it is, within its points", "[navigation]") {
  const OccupancyMap map = wall_with_door(-0.6, 0.6);
  const std::array askew{Vec2{0.5, -1.2}, Vec2{2.0, 0.05}, Vec2{3.5, 1.2}};
  const Path before(askew);
  const Path path = lined_up(map, kLong, before);
  for (const Vec2 point : path.points())
    CHECK(norm(before.at(before.nearest(point, 0.0, before.length())) - point) < 1e-9);
}
