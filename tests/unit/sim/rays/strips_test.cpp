// SPDX-License-Identifier: GPL-3.0-or-later
// How far a cone of rays is empty: never farther than its nearest hit, and not much nearer.
#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/base/random.hpp"
#include "rays/grid.hpp"
#include "rays/strips.hpp"

using namespace orca::sim;
using detail::Cone;
using detail::Elements;
using detail::Grid;
using orca::direction;
using orca::RandomStream;
using orca::rotated;
using orca::Vec2;
using orca::sim::test::kPi;

namespace {

constexpr double kReach = 9.0;
constexpr double kHeight = 0.3;

// Returns posts and boxes at random places around `middle`.
Grid random_posts(RandomStream& random, Vec2 middle, int count) {
  Elements elements;
  for (int i = 0; i < count; ++i) {
    const Vec2 at = middle + Vec2{random.uniform(-6, 6), random.uniform(-6, 6)};
    elements.add(Circle{at, random.uniform(0.02, 0.4)}, {0.0, 1.0});
    elements.add(Box{{at.x, at.y, random.uniform(-kPi, kPi)}, {random.uniform(0.02, 1.5), 0.1}}, {0.0, 1.0});
  }
  return Grid(std::move(elements));
}

// Returns a cone; half of all cones have their axis or a rim along a diagonal or an axis of the grid.
Cone random_cone(RandomStream& random, Vec2 middle) {
  const Vec2 tip = middle + Vec2{random.uniform(-9, 9), random.uniform(-9, 9)};
  const double half_angle = random.chance(0.1) ? 0.0 : random.uniform(0.0, detail::Strips::kWide);
  const double eighth = 0.25 * kPi * std::floor(random.uniform(-4.0, 4.0));
  const double yaw = random.chance(0.5)   ? random.uniform(-kPi, kPi)
                     : random.chance(0.5) ? eighth
                                          : eighth + half_angle;
  return {tip, direction(yaw), half_angle, random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.3), kReach};
}

double nearest_hit(RandomStream& random, const Grid& grid, const Cone& cone) {
  Hit nearest;
  nearest.range = cone.reach;
  for (int i = 0; i <= 40; ++i) {
    const Vec2 start = cone.tip + random.uniform(0.0, cone.slack) * direction(random.uniform(-kPi, kPi));
    const double angle = cone.half_angle * (i / 20.0 - 1.0);
    grid.cast({start, rotated(cone.axis, angle), cone.reach, kHeight}, nearest);
  }
  return nearest.range;
}

}  // namespace

TEST_CASE("no ray of a cone meets anything within its empty depth, near the origin and far from it",
          "[sim][caster]") {
  RandomStream random(21, "test", "cones");
  const Vec2 middle = GENERATE(Vec2{0.0, 0.0}, Vec2{-30'000.0, 50'000.0});
  const int posts = GENERATE(1, 5, 40);
  int worth = 0;
  for (int round = 0; round < 2000; ++round) {
    const Grid grid = random_posts(random, middle, posts);
    const Cone cone = random_cone(random, middle);
    const double depth = grid.empty_depth(cone);
    const double nearest = nearest_hit(random, grid, cone);
    CAPTURE(round, depth, nearest, cone.half_angle, cone.slack);
    REQUIRE(depth >= 0.0);
    REQUIRE(depth <= nearest);
    if (depth > 0.4 * nearest) ++worth;
  }
  CHECK(worth > 300);
}

TEST_CASE(
    "a cone without obstacles is empty all the way, and one that begins at an obstacle is not empty at all",
    "[sim][caster]") {
  Elements elements;
  elements.add(Circle{{5.0, 0.0}, 0.5}, {0.0, 1.0});
  elements.add(Circle{{-5.0, 3.0}, 0.5}, {0.0, 1.0});
  const Grid grid(std::move(elements));
  CHECK(grid.empty_depth({{0, 0}, {0, -1}, 0.3, 0.0, kReach}) == kReach);
  CHECK(grid.empty_depth({{0, 0}, {1, 0}, 0.1, 0.0, kReach}) == Approx(4.0).margin(0.7));
  CHECK(grid.empty_depth({{4.5, 0}, {1, 0}, 0.1, 0.0, kReach}) == 0.0);
  CHECK(Grid({}).empty_depth({{0, 0}, {1, 0}, 0.1, 0.0, kReach}) == kReach);
}

TEST_CASE("a cone too wide to search counts as full", "[sim][caster]") {
  CHECK(Grid({}).empty_depth({{0, 0}, {1, 0}, 0.5 * kPi, 0.0, kReach}) == 0.0);
}

TEST_CASE("a search across many small cells ends early, with a valid result", "[sim][caster]") {
  RandomStream random(22, "test", "corners");
  const Cone cone{{8.0, 8.0}, direction(0.25 * kPi), 0.1, 0.0, 90.0};
  Elements elements;
  while (elements.rounds.size() < 4000) {
    const Vec2 at{random.uniform(-5, 65), random.uniform(-5, 65)};
    const Vec2 seen = rotated(at - cone.tip, -0.25 * kPi);
    if (std::fabs(seen.y) > 0.2 * seen.x + 1.0 || seen.x > 65.0) elements.add(Circle{at, 0.01}, {0.0, 1.0});
  }
  const Grid grid(std::move(elements));
  REQUIRE(grid.regions().count() == 1);
  const double nearest = nearest_hit(random, grid, cone);
  CHECK(nearest > 60.0);
  const double depth = grid.empty_depth(cone);
  CHECK(depth > 5.0);
  CHECK(depth < 50.0);
}
