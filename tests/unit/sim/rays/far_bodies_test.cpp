// SPDX-License-Identifier: GPL-3.0-or-later
// Moving bodies that are far apart, or very large: rays meet them as they meet obstacles at the same places.
#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/base/random.hpp"
#include "orca/sim/caster.hpp"

using namespace orca::sim;
using orca::direction;
using orca::RandomStream;
using orca::Vec2;
using orca::sim::test::kPi;

namespace {

Shape shape_near(RandomStream& random, Vec2 middle) {
  const Vec2 at = middle + Vec2{random.uniform(-10, 10), random.uniform(-10, 10)};
  if (random.chance(0.5)) return Circle{at, random.uniform(0.1, 0.4)};
  return Box{{at.x, at.y, random.uniform(-kPi, kPi)}, {0.3, 0.2}};
}

}  // namespace

TEST_CASE("bodies that are kilometres apart, or a hundred metres long, are met like obstacles",
          "[sim][caster]") {
  const std::size_t count = GENERATE(20U, 320U);
  RandomStream random(41, "test", "far bodies");
  const std::vector<Vec2> places{{0, 0}, {2000, -300}, {-40'000, 60'000}};
  Caster moving({"nothing", {}, {}});
  WorldModel world{"obstacles", {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    Shape shape = shape_near(random, places[i % places.size()]);
    if (i == 5) shape = Box{{30.0, 40.0, 0.5}, {150.0, 60.0}};
    moving.add_body({shape_near(random, {}), 0.0, 1.0});
    moving.move_body(i, shape);
    world.obstacles.push_back({"thing", shape, 1.0});
  }
  const Caster standing(world);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec2 from = places[static_cast<std::size_t>(i) % places.size()] +
                      Vec2{random.uniform(-12, 12), random.uniform(-12, 12)};
    const Ray ray{from, direction(random.uniform(-kPi, kPi)), random.chance(0.1) ? 90'000.0 : 30.0, 0.5};
    const Hit hit = moving.cast(ray);
    CAPTURE(i);
    REQUIRE(hit.range == standing.cast(ray).range);
    REQUIRE(hit.found() == standing.cast(ray).found());
    met += hit.found() ? 1 : 0;
  }
  CHECK(met > 200);
}
